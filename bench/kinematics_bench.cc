#include <benchmark/benchmark.h>

#include <numbers>
#include <vector>

#include "planner/base/random.h"
#include "planner/kinematics/arm.h"

namespace assay::kinematics {
namespace {

constexpr std::size_t kPoses = 4096;  // 0.5 MB of poses: the second-level cache holds them

const Arm& Puma() {
  static const Arm arm = Arm::FromUrdf(ASSAY_SOURCE_DIR "/models/robots/puma762/puma762.urdf");
  return arm;
}

std::vector<JointVector> RandomJointVectors() {
  RandomStream random(1, "kinematics benchmark");
  std::vector<JointVector> vectors(kPoses);
  for (JointVector& q : vectors) {
    for (int i = 0; i < 6; ++i) q[i] = random.Uniform(-std::numbers::pi, std::numbers::pi);
  }
  return vectors;
}

void ForwardKinematics(benchmark::State& state) {
  const std::vector<JointVector> vectors = RandomJointVectors();
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(Puma().Forward(vectors[i]));
    i = (i + 1) % kPoses;
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(ForwardKinematics);

// One item is one pose with all its solutions.
void InverseKinematics(benchmark::State& state) {
  std::vector<Pose> poses;
  for (const JointVector& q : RandomJointVectors()) poses.push_back(Puma().Forward(q));
  std::size_t i = 0;
  std::int64_t solutions = 0;
  for (auto _ : state) {
    const InverseSolutions found = Puma().Inverse(poses[i]);
    benchmark::DoNotOptimize(found);
    solutions += static_cast<std::int64_t>(found.size());
    i = (i + 1) % kPoses;
  }
  state.SetItemsProcessed(state.iterations());
  state.counters["solutions_per_pose"] =
      static_cast<double>(solutions) / static_cast<double>(state.iterations());
}
BENCHMARK(InverseKinematics);

}  // namespace
}  // namespace assay::kinematics
