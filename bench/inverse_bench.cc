#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <vector>

#include "bench/harness/contest.h"
#include "bench/workloads/published_arms.h"
#include "planner/kinematics/inverse/chain_inverse.h"
#ifdef ASSAY_PEER_KDL_INVERSE
#include "bench/peers/kdl_inverse.h"
#endif

namespace assay::kinematics {
namespace {

const int kInversePoses = bench::Tiny() ? 16 : 256;
constexpr double kSolutionError = 1e-9;  // metres and entries of rotations
// Greatest error of a solver that stops at 1e-5 m and 1e-3 radians.
constexpr double kPeerError = 2e-3;

// An arm, its poses, and the number of their solutions.
struct InverseWork {
  explicit InverseWork(const workloads::NamedChain& arm) : inverse(arm.chain) {
    RandomStream random(bench::Seed(), arm.name);
    for (int i = 0; i < kInversePoses; ++i) {
      poses.push_back(arm.chain.Forward(workloads::RandomTurns(random, 6)));
      solutions.push_back(inverse.Solve(poses.back()).size());
    }
  }

  ChainInverse inverse;
  std::vector<Pose> poses;
  std::vector<std::size_t> solutions;
};

bool ReachesPose(const SerialChain& chain, const ChainVector& q, const Pose& X, double tolerance) {
  return (chain.Forward(q).matrix() - X.matrix()).cwiseAbs().maxCoeff() < tolerance;
}

void AllSolutions(const InverseWork& work, benchmark::State& state) {
  double solutions = 0;
  for (const Pose& X : work.poses) {
    for (const SixAngles& q : work.inverse.Solve(X)) {
      ++solutions;
      if (!ReachesPose(work.inverse.chain(), q, X, kSolutionError)) {
        return state.SkipWithError("a solution is wrong");
      }
    }
  }
  for (auto _ : state) {
    for (const Pose& X : work.poses) benchmark::DoNotOptimize(work.inverse.Solve(X));
  }
  state.counters["solutions"] = solutions / kInversePoses;
}

#ifdef ASSAY_PEER_KDL_INVERSE
void AsManyByKdl(const InverseWork& work, benchmark::State& state) {
  peers::KdlInverse solver(work.inverse.chain());
  double found = 0;
  for (const Pose& X : work.poses) {
    const std::optional<JointVector> q = solver.Solve(X);
    if (!q) continue;
    ++found;
    if (!ReachesPose(work.inverse.chain(), *q, X, kPeerError)) {
      return state.SkipWithError("a solution is wrong");
    }
  }
  for (auto _ : state) {
    for (std::size_t i = 0; i < work.poses.size(); ++i) {
      for (std::size_t k = 0; k < work.solutions[i]; ++k) {
        benchmark::DoNotOptimize(solver.Solve(work.poses[i]));
      }
    }
  }
  state.counters["found"] = found / kInversePoses;
}
#endif

void AddArm(const std::string& family, const workloads::NamedChain& arm) {
  const auto work = std::make_shared<const InverseWork>(arm);
  bench::AddContestant(family, arm.name, "assay",
                       [work](benchmark::State& state) { AllSolutions(*work, state); });
#ifdef ASSAY_PEER_KDL_INVERSE
  bench::AddContestant(family, arm.name, "kdl",
                       [work](benchmark::State& state) { AsManyByKdl(*work, state); });
#else
  bench::AddMissing(family, "kdl", "liborocos-kdl-dev");
#endif
}

void AnnounceInverse(const std::string& family, double at_least) {
  bench::Announce(
      family, {.measured = "all solutions of 256 random reachable poses. KDL's "
                           "Levenberg-Marquardt solver is called once for each of them",
               .unfair = "KDL iterates, and finds a solution only for a part of the poses (kdl: "
                         "found). It serves any chain, and gives the same solution each time. "
                         "Debian builds KDL for the oldest processors of the architecture",
               .against = "kdl",
               .at_least = at_least});
}

const bool kArmsAdded = [] {
  const std::string closed = "all-inverse-solutions-closed-form";
  const std::string searched = "all-inverse-solutions-by-search";
  AnnounceInverse(closed, 100);
  AnnounceInverse(searched, 10);
  RandomStream random(bench::Seed(), "arms");
  std::vector<workloads::NamedChain> arms = workloads::PublishedArms();
  for (workloads::NamedChain& arm : workloads::RandomArms(random)) arms.push_back(std::move(arm));
  for (const workloads::NamedChain& arm : arms) {
    const bool is_general = ClassOf(arm.chain).kind == ArmKind::kGeneral;
    AddArm(is_general ? searched : closed, arm);
  }
  return true;
}();

}  // namespace
}  // namespace assay::kinematics
