#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner/algebra/multiaffine/multiaffine_ascent.h"
#include "planner/algebra/multiaffine/multiaffine_derivatives.h"
#include "planner/algebra/multiaffine/multiaffine_form.h"
#include "planner/algebra/multiaffine/multiaffine_point.h"
#include "planner/algebra/multiaffine/sector.h"
#include "planner/numeric/nearest_interval.h"

namespace assay::algebra {

// What a search knows while it answers one question about a multi-affine form: how large does sign
// * form become over a box?
struct MultiaffineQuestion {
  explicit MultiaffineQuestion(MultiaffineForm the_form);
  MultiaffineQuestion(const MultiaffineQuestion&) = delete;
  MultiaffineQuestion& operator=(const MultiaffineQuestion&) = delete;

  // Bounds the rounding errors over a box, which is indexed by variable.
  void BoundErrors(std::span<const Sector> box);
  void Begin(int sign_of_form);

  bool IsAngle(int variable) const { return variable < form.angle_count; }
  NestedForm::AtomSet AtomsOf(const std::vector<int>& variables) const;

  // Substitutes all coordinates of the point in the form, except for the free variables.
  void PutInSettled();
  // Moves the point's given variables to where the form is large, and offers it.
  void Climb(std::span<const int> variables, std::span<const Sector> sectors);
  // Returns the reduced form's value at the point.
  double Value();
  // Keeps the point if the form surely attains more there than at the best point so far. Returns
  // the form's value at the point.
  double Offer();

  const MultiaffineForm form;
  MultiaffineDerivatives<numeric::NearestInterval> over_box;
  MultiaffinePoint point;
  MultiaffineAscent ascent;
  NestedReduction reduction;

  // Bounds of the rounding errors of the form's range over the box, of its value at a point, and of
  // its slopes.
  double error = 0;
  double point_error = 0;
  std::vector<double> slope_error;  // indexed by variable
  double angle_reach = 0;           // a bound of the arguments of the trigonometric polynomials

  int sign = 1;
  NestedForm reduced;         // sign * form with the settled coordinates substituted
  std::vector<Sector> whole;  // the part of the box that monotonicity leaves
  std::vector<int> free;      // variables with a width in `whole`
  double attained = 0;        // the form attains at least this at the best point
  std::vector<double> best_point;
  std::int64_t evaluations = 0;
};

}  // namespace assay::algebra
