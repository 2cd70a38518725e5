#pragma once

#include "planner/algebra/expression/transform.h"
#include "planner/geometry/pose.h"

namespace assay::uncertainty {

using algebra::Expression;
using algebra::SymbolicVector;
using algebra::Transform;
using geometry::Pose;
using geometry::Vector3;

// As published, or such that no certificate can be false (DECISIONS.md, Uncertainty).
enum class Propagation { kPaper, kSound };

// How the hand's pose differs from the commanded one, in its own frame (Spar, equation 1).
struct ManipulatorError {
  Expression x, y, z, theta;  // metres; radians about the tool's z

  Transform AsTransform() const;  // T_dM
};

// How the pose of a part on the table differs from the believed one (Spar, equation 2): its origin
// is displaced in the world, and it is turned about the world's z through its own origin.
struct RestingError {
  SymbolicVector displacement;
  Expression theta;
};

// How the believed pose of a part on the table differs from the planned one: likewise. Sensing
// shifts what is believed.
struct BeliefShift {
  SymbolicVector displacement = {0, 0, 0};
  Expression turn = 0;
};

// How a part in the hand differs from the grasp that was planned, in the frame of the true hand
// (sound) or of the commanded one (paper): the grasped point is off by x along the pads and by z
// along the tool's axis, and the part may be turned about the closing direction (twist). Pads that
// jammed before the faces lay flat on them leave more: y, and rotations about the tool's axis
// (skew) and along the pads (tip).
struct HeldError {
  Expression x, z;                      // metres
  Expression twist = 0;                 // radians about the tool's y
  Expression y = 0, skew = 0, tip = 0;  // metres; radians about the tool's z and x
};

// Numbers as symbols. Entries within 1e-15 of 0, 1 and -1 become these: what rounding leaves of
// right angles is no part of the workcell.
SymbolicVector AsVector(const Vector3& p);
Transform AsTransform(const Pose& pose);

// T_(O+d) = Tr_d Tr_O R_d R_O.
Transform PossiblePose(const Pose& X_WorldPart, const RestingError& error);

// T'_d: the planned grasp frame of a held part as seen from the commanded hand.
Transform PossibleGrasp(const HeldError& error, const ManipulatorError& draw,
                        Propagation propagation);

// T_M T'_d T_G^-1: where a held part is when the hand is told to go to X_WorldTool.
Transform PossibleHeldPose(const Pose& X_WorldTool, const Transform& X_ToolGrasp,
                           const Pose& X_PartTool);

}  // namespace assay::uncertainty
