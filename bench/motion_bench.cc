#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "bench/harness/contest.h"
#include "planner/base/random.h"
#include "planner/domain/problem/problem_file.h"
#include "planner/geometry/pose.h"
#include "planner/motion/collision/swept_volume.h"
#include "planner/motion/paths/joint_trajectory.h"
#include "planner/motion/paths/path_search.h"

namespace assay::motion {
namespace {

constexpr double kRoom = 0.012;  // metres of clearance at the ends, more than is wanted on the way
constexpr int kQueries = 1000;

const domain::Problem& Clutter() {
  static const domain::Problem problem = domain::ReadProblem(
      Document::Load(ASSAY_SOURCE_DIR "/scenarios/clutter.yaml"), ASSAY_SOURCE_DIR "/models");
  return problem;
}

enum class Hand { kEmpty, kHoldingThePeg };

CollisionScene Scene(Hand hand) {
  const PartId peg(1);
  Surroundings surroundings{.opening = 0.05};
  for (int i = 0; i < static_cast<int>(Clutter().parts.size()); ++i) {
    if (hand == Hand::kHoldingThePeg && PartId(i) == peg) continue;
    surroundings.parts.push_back({PartId(i), Clutter().part(PartId(i)).X_WorldPart});
  }
  if (hand == Hand::kHoldingThePeg) {
    const domain::Grasp& grasp = Clutter().part(peg).grasps->front();
    surroundings.held = HeldPart{peg, grasp.X_PartTool};
    surroundings.opening = grasp.width;
  }
  return CollisionScene(Clutter(), surroundings);
}

// Draws free postures with the tool low over the table.
class Postures {
 public:
  explicit Postures(const CollisionScene& scene) : scene_(scene), check_(scene, {kRoom}) {}

  // Draws a posture with the tool straight down, in the configuration of the arm's home. Between
  // postures of other configurations there may be no upright way.
  JointVector DrawUpright() {
    while (true) {
      const double height = random_.Uniform(0.02, 0.35);
      const Pose X_WorldTool =
          geometry::Translation(random_.Uniform(0.3, 1.05), random_.Uniform(-0.6, 0.6), height) *
          geometry::RotationZ(random_.Uniform(-M_PI, M_PI)) * geometry::RotationX(M_PI);
      const kinematics::Arm& arm = scene_.arm();
      for (const auto& solution : arm.Inverse(scene_.workcell().FlangeFor(X_WorldTool))) {
        const JointVector& q = solution.q;
        if (solution.indicators != arm.IndicatorsOf(scene_.workcell().home())) continue;
        if (arm.InRange(q) && !check_.FindObstruction(q, q)) return q;
      }
    }
  }

  JointVector Draw() {
    while (true) {
      JointVector q;
      for (int j = 0; j < 6; ++j) {
        const kinematics::JointLimits& limits = scene_.arm().limits()[static_cast<std::size_t>(j)];
        q[j] = random_.Uniform(limits.lower, limits.upper);
      }
      if (IsLow(q) && !check_.FindObstruction(q, q)) return q;
    }
  }

 private:
  bool IsLow(const JointVector& q) const {
    const domain::Workcell& workcell = scene_.workcell();
    const Vector3 tool = workcell.X_WorldBase() * scene_.arm().Forward(q) *
                         workcell.gripper().X_FlangeTool().translation();
    return tool.x() > 0.3 && tool.x() < 1.05 && std::abs(tool.y()) < 0.6 && tool.z() > 0 &&
           tool.z() < 0.35;
  }

  const CollisionScene& scene_;
  MotionCheck check_;
  RandomStream random_{bench::Seed(), "motion benchmark"};
};

enum class Tool { kAnyhow, kUpright };

std::vector<PathRequest> Queries(const CollisionScene& scene, Tool tool) {
  Postures postures(scene);
  std::vector<PathRequest> queries;
  for (int i = 0; i < kQueries; ++i) {
    const bool upright = tool == Tool::kUpright;
    const JointVector from = upright ? postures.DrawUpright() : postures.Draw();
    const JointVector to = upright ? postures.DrawUpright() : postures.Draw();
    queries.push_back({.from = from, .to = to});
    if (upright) queries.back().rules.upright = Upright{.tilt = 10 * M_PI / 180};
  }
  return queries;
}

double Share(std::vector<double>& sorted, double share) {
  std::ranges::sort(sorted);
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

// Each iteration is one query, from a free posture low over the table to another.
void PathBetweenRandomPostures(benchmark::State& state, Hand hand, Tool tool) {
  const CollisionScene scene = Scene(hand);
  const std::vector<PathRequest> queries = Queries(scene, tool);
  const JointRates rates = RatesOf(scene.workcell());
  std::vector<double> milliseconds;
  std::vector<double> durations;
  std::size_t next = 0;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    const PathResult result = FindPath(scene, queries[next++ % queries.size()]);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    milliseconds.push_back(took.count());
    if (const auto* path = std::get_if<JointPath>(&result)) {
      durations.push_back(AlongPath(*path, rates).duration());
    }
  }
  state.counters["solved"] =
      static_cast<double>(durations.size()) / static_cast<double>(milliseconds.size());
  state.counters["median_ms"] = Share(milliseconds, 0.5);
  state.counters["p99_ms"] = Share(milliseconds, 0.99);
  state.counters["median_motion_s"] = Share(durations, 0.5);
}
BENCHMARK_CAPTURE(PathBetweenRandomPostures, EmptyHand, Hand::kEmpty, Tool::kAnyhow)
    ->Iterations(bench::Tiny() ? 4 : kQueries);
BENCHMARK_CAPTURE(PathBetweenRandomPostures, HoldingThePeg, Hand::kHoldingThePeg, Tool::kAnyhow)
    ->Iterations(bench::Tiny() ? 4 : kQueries);

BENCHMARK_CAPTURE(PathBetweenRandomPostures, KeptUpright, Hand::kEmpty, Tool::kUpright)
    ->Iterations(bench::Tiny() ? 2 : 200);

void SweptVolumeOfAPath(benchmark::State& state) {
  const CollisionScene scene = Scene(Hand::kHoldingThePeg);
  Postures postures(scene);
  const JointPath path = {postures.Draw(), postures.Draw()};
  std::size_t pieces = 0;
  for (auto _ : state) pieces = SweptVolume(scene, path, {}).size();
  state.counters["pieces"] = static_cast<double>(pieces);
}
BENCHMARK(SweptVolumeOfAPath)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace assay::motion
