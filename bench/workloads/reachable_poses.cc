#include "bench/workloads/reachable_poses.h"

#include <numbers>

namespace assay::workloads {

using kinematics::JointVector;

JointVector RandomJoints(double bound, RandomStream& random) {
  JointVector q;
  for (int i = 0; i < 6; ++i) q[i] = random.Uniform(-bound, bound);
  return q;
}

std::vector<JointVector> RandomJointVectors(std::size_t count, std::uint64_t seed) {
  RandomStream random(seed, "joint vectors");
  std::vector<JointVector> vectors(count);
  for (JointVector& q : vectors) q = RandomJoints(std::numbers::pi, random);
  return vectors;
}

std::vector<geometry::Pose> RandomReachablePoses(const kinematics::Arm& arm, std::size_t count,
                                                 std::uint64_t seed) {
  std::vector<geometry::Pose> poses;
  for (const JointVector& q : RandomJointVectors(count, seed)) poses.push_back(arm.Forward(q));
  return poses;
}

}  // namespace assay::workloads
