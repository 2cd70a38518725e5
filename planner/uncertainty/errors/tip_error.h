#pragma once

#include "planner/uncertainty/preconditions/precondition.h"

namespace assay::uncertainty {

// By how much the tip of a held part (plan::Strategy) is elsewhere than where it is believed to be,
// as the fixed part of the mating sees it: displaced by d, and turned about its origin. In the
// fixed part's axes.
struct TipError {
  SymbolicVector d;     // metres
  SymbolicVector sine;  // the turn's axis, of the length of the sine of its angle
};

// The way of the tip, as far as its error depends on it.
struct TipWay {
  Pose X_HeldTip;
  Pose X_FixedStart;
  geometry::Matrix3 R_FixedEnd;  // how it is turned at last
};
TipWay WayOf(const plan::Strategy& strategy);

// At the start, and turned as at the end, this as it is seen when it is turned back to the start.
// Fine motion takes it that errors turn with the hand: those of the hand and of the grasp do, and
// those of the fixed part do not, so that the two differ. X_ToolGrasp is T'_d.
std::vector<TipError> TipErrors(const UncertainWorld& world, domain::MatingId mating,
                                const plan::Hold& hold, const Transform& X_ToolGrasp,
                                const TipWay& way);

// A box that contains them: half widths of the displacement, and of the components of the rotation
// vector; pi each where turns may reach a right angle.
struct TipBox {
  Vector3 d = Vector3::Zero();
  Vector3 w = Vector3::Zero();
};
TipBox BoxOf(const UncertainWorld& world, const std::vector<TipError>& errors);

// If no component of a turn's sine vector is greater than these, none of its rotation vector is
// greater than w.
Vector3 SinesWithin(const Vector3& w);

}  // namespace assay::uncertainty
