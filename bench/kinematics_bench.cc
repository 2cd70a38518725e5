#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "bench/harness/contest.h"
#include "bench/workloads/reachable_poses.h"
#include "planner/kinematics/arm.h"
#include "planner/kinematics/inverse/serial_chain.h"
#include "planner/kinematics/inverse_batch.h"
#ifdef ASSAY_PEER_KDL_INVERSE
#include "bench/peers/kdl_inverse.h"
#endif

namespace assay::kinematics {
namespace {

// 0.5 MB of poses, which the second-level cache holds.
const std::size_t kPoses = bench::Tiny() ? 64 : 4096;
constexpr double kExact = 1e-9;  // greatest error in metres and in entries of rotations
// Greatest error of a solver that stops at 1e-5 m and 1e-3 radians.
constexpr double kIterated = 2e-3;

const Arm& Puma() {
  static const Arm arm = Arm::FromUrdf(ASSAY_SOURCE_DIR "/models/robots/puma762/puma762.urdf");
  return arm;
}

const std::vector<Pose>& ReachablePoses() {
  static const std::vector<Pose> poses =
      workloads::RandomReachablePoses(Puma(), kPoses, bench::Seed());
  return poses;
}

bool Reaches(const JointVector& q, const Pose& X_BaseFlange, double tolerance) {
  return (Puma().Forward(q).matrix() - X_BaseFlange.matrix()).cwiseAbs().maxCoeff() < tolerance;
}

void ForwardKinematics(benchmark::State& state) {
  const std::vector<JointVector> vectors = workloads::RandomJointVectors(kPoses, bench::Seed());
  for (auto _ : state) {
    for (const JointVector& q : vectors) benchmark::DoNotOptimize(Puma().Forward(q));
  }
}
BENCHMARK(ForwardKinematics)->Name("ForwardKinematicsOf4096");

// Times all eight solutions of each pose.
void OneByOne(benchmark::State& state) {
  for (const Pose& X : ReachablePoses()) {
    const InverseSolutions found = Puma().Inverse(X);
    if (found.size() != 8) return state.SkipWithError("not eight solutions");
    for (const InverseSolution& solution : found) {
      if (!Reaches(solution.q, X, kExact)) return state.SkipWithError("a solution is wrong");
    }
  }
  for (auto _ : state) {
    for (const Pose& X : ReachablePoses()) benchmark::DoNotOptimize(Puma().Inverse(X));
  }
  state.counters["solutions"] = 8;
}

std::vector<PoseBatch> Batches(const std::vector<Pose>& poses) {
  std::vector<PoseBatch> batches;
  for (std::size_t i = 0; i + kBatch <= poses.size(); i += kBatch) {
    batches.push_back(Batch(std::span<const Pose, kBatch>(&poses[i], kBatch)));
  }
  return batches;
}

// Times batches of poses. Only regular poses are checked, and the share of other poses is a
// counter.
void InBatches(benchmark::State& state) {
  const std::vector<PoseBatch> batches = Batches(ReachablePoses());
  SolutionBatch found;
  int regular = 0;
  for (std::size_t i = 0; i < batches.size(); ++i) {
    Inverse(*Puma().geometry(), batches[i], found);
    for (int pose = 0; pose < kBatch; ++pose) {
      if (!found.regular[static_cast<std::size_t>(pose)]) continue;
      ++regular;
      const Pose& X = ReachablePoses()[i * kBatch + static_cast<std::size_t>(pose)];
      for (int k = 0; k < 8; ++k) {
        if (!Reaches(found.Solution(k, pose), X, kExact)) {
          return state.SkipWithError("a solution is wrong");
        }
      }
    }
  }
  for (auto _ : state) {
    for (const PoseBatch& batch : batches) {
      Inverse(*Puma().geometry(), batch, found);
      benchmark::DoNotOptimize(found);
    }
  }
  state.counters["solutions"] = 8;
  state.counters["regular"] = regular / static_cast<double>(kPoses);
}

#ifdef ASSAY_PEER_KDL_INVERSE
void Kdl(benchmark::State& state) {
  peers::KdlInverse solver(SerialChain::FromModel(Puma().model()));
  int found = 0;
  for (const Pose& X : ReachablePoses()) {
    const std::optional<JointVector> q = solver.Solve(X);
    if (!q) continue;
    ++found;
    if (!Reaches(*q, X, kIterated)) return state.SkipWithError("a solution is wrong");
  }
  for (auto _ : state) {
    for (const Pose& X : ReachablePoses()) benchmark::DoNotOptimize(solver.Solve(X));
  }
  state.counters["found"] = found / static_cast<double>(kPoses);
}
#endif

void AddInverse(const char* family, void (*ours)(benchmark::State&), double at_least,
                const std::string& unfair_besides) {
  bench::Announce(
      family,
      {.measured = "4,096 random reachable poses. For each pose, assay computes all eight "
                   "solutions, and KDL's Levenberg-Marquardt solver computes one",
       .unfair =
           std::string("KDL serves any chain and iterates. It finds a solution only for a part of "
                       "the poses (kdl: found). assay uses the closed form of the arm. Debian "
                       "builds KDL for the oldest processors of the architecture") +
           unfair_besides,
       .against = "kdl",
       .at_least = at_least});
  bench::AddContestant(family, "puma762", "assay", ours);
#ifdef ASSAY_PEER_KDL_INVERSE
  bench::AddContestant(family, "puma762", "kdl", Kdl);
#else
  bench::AddMissing(family, "kdl", "liborocos-kdl-dev");
#endif
}

const bool kAdded = [] {
  AddInverse("inverse-kinematics", OneByOne, 150, "");
  AddInverse("inverse-kinematics-in-batches", InBatches, 800,
             ". The poses for assay are put into batches before the clock runs, and the solutions "
             "stay in the batches");
  return true;
}();

}  // namespace
}  // namespace assay::kinematics
