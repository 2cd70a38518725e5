#pragma once

#include <cstdint>
#include <vector>

#include "planner/base/random.h"
#include "planner/kinematics/arm.h"

namespace assay::workloads {

// Draws each joint within +-`bound` radians, whatever the joint's limits.
kinematics::JointVector RandomJoints(double bound, RandomStream& random);

// Draws vectors with each joint within half a turn.
std::vector<kinematics::JointVector> RandomJointVectors(std::size_t count, std::uint64_t seed);

// Returns poses of the flange in the base's frame that an arm without limits reaches: those of
// RandomJointVectors.
std::vector<geometry::Pose> RandomReachablePoses(const kinematics::Arm& arm, std::size_t count,
                                                 std::uint64_t seed);

}  // namespace assay::workloads
