#pragma once

#include "planner/kinematics/inverse/bounded_list.h"

namespace assay::kinematics {

// The function constant + cosine cos(x) + sine sin(x) + cosine2 cos(2x) + sine2 sin(2x).
struct TrigonometricQuadratic {
  double constant = 0;
  double cosine = 0;
  double sine = 0;
  double cosine2 = 0;
  double sine2 = 0;

  double At(double angle) const;
  double SlopeAt(double angle) const;
};

// Returns the angles in [-pi, pi] at which the function is zero, by the closed form of the quartic
// equation for the tangent of half the angle. A double root may be given twice. A least value that
// nearly vanishes counts as a root; the caller may test the value.
BoundedList<double, 4> RootsOf(const TrigonometricQuadratic& f);

}  // namespace assay::kinematics
