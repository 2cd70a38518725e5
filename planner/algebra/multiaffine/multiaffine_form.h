#pragma once

#include <optional>
#include <vector>

#include "planner/algebra/forms/nested_form.h"
#include "planner/algebra/forms/normal_form.h"

namespace assay::algebra {

// A sum of products in each of which a variable occurs once at most: as itself (a displacement) or
// as its sine or cosine (an angle). Chains of transforms with errors of their own are of this kind.
// In a displacement such a form is affine, in an angle A cos + B sin + C.
//
// Its arithmetic rounds to nearest, with one bound for all errors: a result that every term reaches
// through at most n roundings is off by no more than n (1 + small) units of rounding times the sum
// of the terms' magnitudes (Higham 2002, "Accuracy and Stability of Numerical Algorithms", lemma
// 3.1). The magnitude of a sine or cosine counts as 1, which holds for derivatives by angles, too.
struct MultiaffineForm {
  struct Variable {
    VariableId id;
    bool is_angle = false;
  };

  std::vector<Variable> variables;  // angles first; what is in more terms before what is in fewer
  int angle_count = 0;
  NestedForm nested;  // of the products
  // By magnitudes of displacements: how far the form's value at a point, computed once, may be off;
  // and anything else that is computed of the form: its range and derivatives over a box, also once
  // coordinates that are known have been put in.
  NestedForm point_error, error;

  int atom_count() const { return angle_count + static_cast<int>(variables.size()); }
  // The atom of a displacement, or of an angle's cosine; its sine is the next one. By the place in
  // `variables`.
  int AtomOf(int variable) const {
    return variable < angle_count ? 2 * variable : variable + angle_count;
  }
};

// None if the normal form is not of this kind, a number, or has more atoms than
// NestedForm::kMostAtoms.
std::optional<MultiaffineForm> MultiaffineFormOf(const NormalForm& form);

}  // namespace assay::algebra
