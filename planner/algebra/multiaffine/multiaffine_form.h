#pragma once

#include <optional>
#include <vector>

#include "planner/algebra/multiaffine/nested_form.h"
#include "planner/algebra/normal_forms/normal_form.h"

namespace assay::algebra {

// A sum of products in which a variable occurs at most once per product: either as itself (a
// displacement), or as its sine or cosine (an angle). Chains of transforms with independent errors
// have this form. It is affine in a displacement, and it is A cos + B sin + C in an angle.
//
// The arithmetic rounds to nearest, with one bound for all errors. If every term goes through at
// most n roundings, the result is off by at most n (1 + small) units of rounding times the sum of
// the terms' magnitudes (Higham 2002, "Accuracy and Stability of Numerical Algorithms", lemma 3.1).
// The magnitude of a sine or cosine counts as 1, and this holds for derivatives with respect to
// angles, too.
struct MultiaffineForm {
  struct Variable {
    VariableId id;
    bool is_angle = false;
  };

  std::vector<Variable> variables;  // angles first; among each kind, those in more terms first
  int angle_count = 0;
  NestedForm nested;  // the sum of products
  // Bounds of the rounding error, as functions of the displacements' magnitudes. `point_error` is
  // for the form's value at a point, computed once. `error` is for everything else: the form's
  // range and the form's derivatives over a box, even after known coordinates have been
  // substituted.
  NestedForm point_error, error;

  int atom_count() const { return angle_count + static_cast<int>(variables.size()); }
  // Returns the atom of a displacement, or the atom of an angle's cosine; the atom of its sine
  // follows. The argument is the place in `variables`.
  int AtomOf(int variable) const {
    return variable < angle_count ? 2 * variable : variable + angle_count;
  }
};

// Returns nothing if the normal form is not of this kind, is a number, or has more atoms than
// NestedForm::kMostAtoms.
std::optional<MultiaffineForm> MultiaffineFormOf(const NormalForm& form);

}  // namespace assay::algebra
