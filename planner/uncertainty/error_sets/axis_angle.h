#pragma once

#include <numbers>

#include "planner/uncertainty/error_sets/uncertain_pose.h"

namespace assay::uncertainty {

inline constexpr double kRightAngle = std::numbers::pi / 2;

// Returns the world's vertical in the tool's axes. If an error is a rotation about the vertical,
// each component says which share of the rotation is about that axis. Components below 1e-12 are
// rounding and count as 0.
Vector3 VerticalInTool(const Pose& X_WorldTool);

// These functions split an error of rotation by at most `angle` into a twist about a second axis
// and a swing (swing-twist decomposition). `cosine` is the cosine of the angle between the two
// axes. They return the greatest possible twist and swing. Angles are in radians; angle >= 0, and
// the results are at most pi.
double TwistOf(double angle, double cosine);
double SwingOf(double angle, double cosine);

}  // namespace assay::uncertainty
