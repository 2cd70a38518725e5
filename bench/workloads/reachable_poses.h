#pragma once

#include <cstdint>
#include <vector>

#include "planner/base/random.h"
#include "planner/kinematics/arm.h"

namespace assay::workloads {

// Each joint anywhere within +-`bound` radians, whatever its limits are.
kinematics::JointVector RandomJoints(double bound, RandomStream& random);

// Within half a turn.
std::vector<kinematics::JointVector> RandomJointVectors(std::size_t count, std::uint64_t seed);

// Poses of the flange in the base's frame that an arm without limits reaches: of these vectors.
std::vector<geometry::Pose> RandomReachablePoses(const kinematics::Arm& arm, std::size_t count,
                                                 std::uint64_t seed);

}  // namespace assay::workloads
