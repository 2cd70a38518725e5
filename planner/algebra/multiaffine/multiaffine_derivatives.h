#pragma once

#include <vector>

#include "planner/algebra/multiaffine/multiaffine_form.h"
#include "planner/algebra/multiaffine/sector.h"

namespace assay::algebra {

// Computes the value of a multi-affine form and its derivatives with respect to the variables, at a
// point (Number = double) or over a box (NearestInterval). Some coordinates may already be
// substituted in the form. Results are rounded to nearest; MultiaffineForm bounds the error. A
// variable is identified by its place in the form's list.
template <class Number>
class MultiaffineDerivatives {
 public:
  explicit MultiaffineDerivatives(const MultiaffineForm& form)
      : form_(form), atoms_(form.atom_count()), tangent_(form.atom_count()) {}

  void SetDisplacement(int variable, const Number& x) { atoms_[form_.AtomOf(variable)] = x; }
  void SetAngle(int variable, const Number& cosine, const Number& sine) {
    atoms_[form_.AtomOf(variable)] = cosine;
    atoms_[form_.AtomOf(variable) + 1] = sine;
  }
  const std::vector<Number>& atoms() const { return atoms_; }

  Number Value(const NestedForm& nested) { return evaluation_.Value(nested, atoms_); }

  // Call Value at the same place first.
  void Differentiate(const NestedForm& nested) { slopes_ = &evaluation_.Slopes(nested, atoms_); }
  Number Slope(int variable) const { return SlopeIn(*slopes_, variable); }
  Number SlopeByAtom(int atom) const { return (*slopes_)[atom]; }
  Number Curvature(int angle) const {
    const int cosine = form_.AtomOf(angle);
    return -(atoms_[cosine] * (*slopes_)[cosine] + atoms_[cosine + 1] * (*slopes_)[cosine + 1]);
  }

  // Call Differentiate at the same place first.
  void DifferentiateSlopes(const NestedForm& nested, int angle) {
    const int cosine = form_.AtomOf(angle);
    tangent_[cosine] = -atoms_[cosine + 1];
    tangent_[cosine + 1] = atoms_[cosine];
    slopes_along_ = &evaluation_.SlopesAlong(nested, atoms_, tangent_);
    tangent_[cosine] = tangent_[cosine + 1] = 0;
  }
  // Returns the second derivative with respect to that angle and another variable.
  Number MixedCurvature(int variable) const { return SlopeIn(*slopes_along_, variable); }

 private:
  Number SlopeIn(const std::vector<Number>& slopes, int variable) const {
    const int atom = form_.AtomOf(variable);
    if (variable >= form_.angle_count) return slopes[atom];
    return atoms_[atom] * slopes[atom + 1] + -(atoms_[atom + 1] * slopes[atom]);
  }

  const MultiaffineForm& form_;
  std::vector<Number> atoms_, tangent_;  // indexed by atom
  NestedEvaluation<Number> evaluation_;
  const std::vector<Number>* slopes_ = nullptr;        // indexed by atom
  const std::vector<Number>* slopes_along_ = nullptr;  // indexed by atom
};

}  // namespace assay::algebra
