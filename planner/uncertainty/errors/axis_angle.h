#pragma once

#include "planner/uncertainty/errors/uncertain_pose.h"

namespace assay::uncertainty {

// The world's vertical in the axes of a tool: how a rotation about it is shared among them.
// Components below 1e-12 are rounding and count as 0.
Vector3 VerticalInTool(const Pose& X_WorldTool);

// A rotation by at most `angle` about an axis that makes an angle with this cosine with another one
// is a twist about the other, of at most so much, and a swing (swing-twist decomposition). Radians,
// angle >= 0, answers up to pi.
double TwistOf(double angle, double cosine);
double SwingOf(double angle, double cosine);

}  // namespace assay::uncertainty
