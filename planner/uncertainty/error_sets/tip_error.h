#pragma once

#include "planner/uncertainty/preconditions/precondition.h"

namespace assay::uncertainty {

// The error of the tip of a held part (plan::Strategy) against its believed pose, in the frame of
// the fixed part of the mating: the tip is displaced by d, and turned about its origin. Both are in
// the fixed part's axes.
struct TipError {
  SymbolicVector d;     // metres
  SymbolicVector sine;  // the turn's axis, as long as the sine of the turn's angle
};

// The data of the tip's way on which its error depends.
struct TipWay {
  Pose X_HeldTip;
  Pose X_FixedStart;
  geometry::Matrix3 R_FixedEnd;  // the tip's orientation at the end
};
TipWay WayOf(const plan::Strategy& strategy);

// Returns two errors of the tip: the error at the start, and the error after the tip has been
// turned as at the end. The second error is given as it is seen after the tip is turned back to the
// start. Fine motion assumes that errors turn with the hand. The errors of the hand and of the
// grasp turn with the hand, but the errors of the fixed part do not, so the two results differ.
// X_ToolGrasp is T'_d.
std::vector<TipError> TipErrors(const UncertainWorld& world, domain::MatingId mating,
                                const plan::Hold& hold, const Transform& X_ToolGrasp,
                                const TipWay& way);

// A box around a set of tip errors: half widths of the displacement (metres), and of the components
// of the rotation vector (radians). The rotation's half widths are pi each where turns may reach a
// right angle.
struct TipBox {
  Vector3 d = Vector3::Zero();
  Vector3 w = Vector3::Zero();
};
TipBox BoxOf(const UncertainWorld& world, const std::vector<TipError>& errors);

// Returns bounds on the components of a turn's sine vector: while the sine vector keeps within
// them, no component of the rotation vector exceeds that of w.
Vector3 SinesWithin(const Vector3& w);

}  // namespace assay::uncertainty
