#pragma once

#include "planner/algebra/expression/transform.h"
#include "planner/geometry/coordinates.h"

namespace assay::uncertainty {

using algebra::Expression;
using algebra::SymbolicVector;
using algebra::Transform;
using geometry::Pose;
using geometry::Vector3;

// The way in which errors are propagated: as published, or in such a way that no certificate can be
// false (README.md, Decisions).
enum class Propagation { kPaper, kSound };

// The error of the hand's pose against the commanded one, in the commanded hand's frame (Spar,
// equation 1).
struct ManipulatorError {
  Expression x, y, z, theta;  // metres; radians about the tool's z

  Transform AsTransform() const;  // T_dM
};

// The error of a part on the table against its believed pose (Spar, equation 2): the part's origin
// is displaced in the world, and the part is turned about the world's z through its own origin.
struct RestingError {
  SymbolicVector displacement;
  Expression theta;
};

// The difference between the believed pose of a part on the table and its planned pose: a
// displacement of its origin and a turn about the world's z, as in RestingError. Sensing changes
// the believed pose.
struct BelievedShift {
  SymbolicVector displacement = {0, 0, 0};
  Expression turn = 0;
};

// The error of a part in the hand against the planned grasp, in the frame of the true hand (sound
// mode) or of the commanded one (paper mode). The grasped point is off by x along the pads and by z
// along the tool's axis, and the part may be turned about the closing direction (twist). Pads that
// jammed before the faces lay flat on them leave three more errors: y, and rotations about the
// tool's axis (skew) and about the axis along the pads (tip).
struct HeldError {
  Expression x, z;                      // metres
  Expression twist = 0;                 // radians about the tool's y
  Expression y = 0, skew = 0, tip = 0;  // metres; radians about the tool's z and x
  // True if the pads closed on a round side whose axis is the tool's z. Such a part touches the
  // pads alike at every turn.
  bool is_round = false;
};

// Converts numbers to constant symbols. Entries within 1e-15 of 0, 1 and -1 become exactly these
// values: what rounding leaves of right angles is no property of the workcell.
SymbolicVector AsVector(const Vector3& p);
Transform AsTransform(const Pose& pose);

// Returns the possible pose of a part that rests: T_(O+d) = Tr_d Tr_O R_d R_O.
Transform PossiblePose(const Pose& X_WorldPart, const RestingError& error);

// Returns T'_d: the planned grasp frame of a held part as seen from the commanded hand.
Transform PossibleGrasp(const HeldError& error, const ManipulatorError& draw,
                        Propagation propagation);

// Returns T_M T'_d T_G^-1: the pose of a held part when the hand is commanded to X_WorldTool.
Transform PossibleHeldPose(const Pose& X_WorldTool, const Transform& X_ToolGrasp,
                           const Pose& X_PartTool);

}  // namespace assay::uncertainty
