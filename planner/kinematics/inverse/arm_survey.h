#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planner/kinematics/inverse/chain_inverse.h"

namespace assay::kinematics {

// What random postures tell about an arm. Lengths are in metres, angles in radians.
struct ArmSurvey {
  ArmClass arm;
  std::string description = {};   // of the class, in words
  std::string locked_joint = {};  // of an arm with seven joints; else empty
  int poses = 0;                  // of the tip, at random joint values within the limits
  std::size_t fewest = 0;         // solutions of a pose, without regard to limits
  std::size_t most = 0;
  double mean = 0;
  double mean_within_limits = 0;  // solutions that have values within the limits
  // The greatest difference between a pose and the pose of one of its solutions, in metres and in
  // entries of rotations.
  double pose_error = 0;
  // The greatest difference between the joint values of a posture and the nearest solution for its
  // pose.
  double return_error = 0;
  int not_returned = 0;  // postures that are no solution for their pose, by more than 1e-5
  double nearest = 0;    // distances of the tip from the base's origin
  double farthest = 0;
  double lowest = 0;  // heights of the tip in the base's frame
  double highest = 0;
  std::vector<std::string> singular = {};  // sentences about the class's singular postures
};

// Surveys a chain with six or seven joints. The result depends on nothing but the chain and the
// seed.
ArmSurvey Survey(const SerialChain& chain, int poses, std::uint64_t seed);

}  // namespace assay::kinematics
