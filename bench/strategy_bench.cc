#include <benchmark/benchmark.h>

#include <algorithm>
#include <numbers>

#include "bench/workloads/pegs.h"
#include "planner/finemotion/strategy_search/strategy_search.h"

namespace assay::finemotion {
namespace {

constexpr double kHalf = 0.01905;       // half of the peg's width, metres
constexpr double kClearance = 0.25e-3;  // metres on each side
constexpr double kReach = 0.012;
constexpr double kTurn = 0.03;  // radians by which the part may be turned

// The wanted times: of a search for both critical points of the square peg (at the rim and at the
// bottom), and of a search with a hundred tolerances.
constexpr double kAtMostMilliseconds = 2 * 100;
constexpr int kManyTolerances = 100;
constexpr double kAtMostMillisecondsWithMany = 10'000;

Passage SquarePegInHole() {
  Passage passage;
  passage.moving = workloads::BoxShape({-kHalf, -kHalf, 0}, {kHalf, kHalf, 0.07});
  passage.stationary = workloads::SquareHoleShape(kHalf + kClearance, 0.038, 0.07);
  passage.seat = 0.06;
  return passage;
}

// Returns a multiple of 2 mm and 1 degree, in all six dimensions.
FineMotionErrors ErrorsOf(double multiple) {
  FineMotionErrors errors;
  errors.pose << Vector3::Constant(2e-3), Vector3::Constant(std::numbers::pi / 180);
  errors.pose *= multiple;
  return errors;
}

// Returns the pose of a tilted peg whose lowest corner is on the face beside the hole.
Pose OnTheFace() {
  GeneralizedPoint z(kPoseDimensions);
  z << 0, 0, 0, 0.15, -0.12, 0;
  Pose X = Displaced(Pose::Identity(), z);
  X.translation() = Vector3(-0.028, -0.026, 0) - X * Vector3(-kHalf, -kHalf, 0);
  return X;
}

void Search(benchmark::State& state, double multiple) {
  const Passage passage = SquarePegInHole();
  const FineMotionErrors errors = ErrorsOf(multiple);
  const StrategyOptions options = {.seed = static_cast<std::uint64_t>(state.range(0))};
  FineMotionPlan plan;
  for (auto _ : state) plan = SearchStrategy(passage, errors, options);
  state.counters["found"] = plan.found() ? 1 : 0;
  state.counters["absorbed"] = plan.absorbed;
  state.counters["motions"] = static_cast<double>(plan.motions.size());
  state.counters["nodes"] = plan.expanded;
  state.counters["replayed"] = plan.replayed;
  state.counters["exact_replays"] = plan.exact_replays;
  state.counters["at_most_ms"] = kAtMostMilliseconds;
}

// --- Growth of the cost of a node. A search ends after kNodes nodes and moves no starts. No
// sequence absorbs the errors of this search, so the search does not end sooner.

constexpr int kNodes = 20;  // nodes of one search; there is a second search, for twice the errors

StrategyOptions FixedNodes() {
  return {.rounds = 1,
          .diverse_rounds = 0,
          .tries = 0,
          .nodes = kNodes,
          .thorough_nodes = 0,
          .seed = 3};
}

void SearchNodes(const Passage& passage, const FineMotionErrors& errors,
                 const StrategyOptions& options, benchmark::State& state) {
  FineMotionPlan plan;
  for (auto _ : state) plan = SearchStrategy(passage, errors, options);
  const ContactFinder finder(passage.moving, passage.stationary, passage.tolerances);
  state.counters["contacts"] = static_cast<double>(
      finder.Near(passage.X_StationaryEntry, {.reach = kReach, .turn = kTurn}).size());
  state.counters["nodes"] = plan.expanded;
  state.counters["replayed"] = plan.replayed;
  state.counters["tests"] = plan.comparison.tests;  // number of tests whether a contact can be made
  state.counters["per_node"] = benchmark::Counter(
      plan.expanded, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// Times nodes by the number of contacts: pegs of this many sides.
void NodesBySides(benchmark::State& state) {
  const Passage passage = workloads::PegInHole(
      {.sides = static_cast<int>(state.range(0)), .half = kHalf, .length = 0.07}, kClearance);
  SearchNodes(passage, ErrorsOf(1), FixedNodes(), state);
}

// Times nodes by the number of drawn starts. The starts stand for the paper's target points, the
// points between which motions lead. From a start on, a node has one maneuver for each contact and
// direction.
void NodesByStarts(benchmark::State& state) {
  StrategyOptions options = FixedNodes();
  options.starts = static_cast<int>(state.range(0));
  SearchNodes(SquarePegInHole(), ErrorsOf(1), options, state);
}

// Adds this many tolerances, to the faces of peg and hole in turn.
Passage WithTolerances(Passage passage, int count) {
  const int moving = static_cast<int>(passage.moving.faces.size());
  const int faces = moving + static_cast<int>(passage.stationary.faces.size());
  for (int i = 0; i < count; ++i) {
    const int face = i % faces;
    const bool of_moving = face < moving;
    passage.tolerances.push_back(
        {.name = "face",
         .of = of_moving ? ModelTolerance::Of::kMovingFaces : ModelTolerance::Of::kStationaryFaces,
         .faces = {of_moving ? face : face - moving}});
  }
  return passage;
}

// Sets tolerances that for each face add up to a twentieth of the play.
FineMotionErrors WithTolerances(FineMotionErrors errors, const Passage& passage) {
  const std::size_t count = passage.tolerances.size();
  const std::size_t faces = passage.moving.faces.size() + passage.stationary.faces.size();
  const std::size_t on_each_face = std::max<std::size_t>(1, (count + faces - 1) / faces);
  errors.tolerances.setConstant(static_cast<Eigen::Index>(count),
                                0.05 * kClearance / static_cast<double>(on_each_face));
  return errors;
}

void NodesByTolerances(benchmark::State& state) {
  const Passage passage = WithTolerances(SquarePegInHole(), static_cast<int>(state.range(0)));
  SearchNodes(passage, WithTolerances(ErrorsOf(1), passage), FixedNodes(), state);
}

// --- Whole searches.

void Tolerances(benchmark::State& state) {
  const Passage passage = WithTolerances(SquarePegInHole(), static_cast<int>(state.range(0)));
  const FineMotionErrors errors = WithTolerances(ErrorsOf(1), passage);
  FineMotionPlan plan;
  for (auto _ : state) plan = SearchStrategy(passage, errors, {.seed = 3});
  state.counters["found"] = plan.found() ? 1 : 0;
  state.counters["absorbed"] = plan.absorbed;
  state.counters["nodes"] = plan.expanded;
  state.counters["replayed"] = plan.replayed;
  if (state.range(0) == kManyTolerances) {
    state.counters["at_most_ms"] = kAtMostMillisecondsWithMany;
  }
}

// Counts how often the paper's edge test would have given another answer.
void Compared(benchmark::State& state) {
  const Passage passage = SquarePegInHole();
  FineMotionPlan plan;
  for (auto _ : state) {
    plan = SearchStrategy(passage, ErrorsOf(1), {.test = MeetingTest::kCompare, .seed = 3});
  }
  state.counters["tests"] = plan.comparison.tests;
  state.counters["compared"] = plan.comparison.compared;
  state.counters["missed"] = plan.comparison.missed;
}

void Contacts(benchmark::State& state) {
  const Passage passage = SquarePegInHole();
  const ContactFinder finder(passage.moving, passage.stationary);
  const Pose X = OnTheFace();
  std::size_t count = 0;
  for (auto _ : state) {
    const auto contacts = finder.Near(X, {.reach = kReach, .turn = kTurn});
    benchmark::DoNotOptimize(count = contacts.size());
  }
  state.counters["contacts"] = static_cast<double>(count);
}

void CheckDown(benchmark::State& state, Margins margins) {
  const Passage passage = SquarePegInHole();
  const MotionChecker checker(passage.moving, ContactFinder(passage.moving, passage.stationary),
                              {});
  PoseChange down = PoseChange::Zero();
  down.z() = -0.01;
  const Command command = {down, {}, ContactKey{ContactKind::kVertexFace, 0, 0}};
  const BelievedPose believed = {Displaced(OnTheFace(), -down), ErrorsOf(1).pose.asDiagonal()};
  CertainMotion motion;
  for (auto _ : state) motion = checker.Check(believed, command, margins);
  state.counters["certain"] = motion.check.certain ? 1 : 0;
  state.counters["unwanted"] = static_cast<double>(motion.check.unwanted.size());
}

BENCHMARK_CAPTURE(Search, half_errors, 0.5)
    ->ArgName("seed")
    ->DenseRange(1, 3)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Search, all_errors, 1.0)
    ->ArgName("seed")
    ->DenseRange(1, 3)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(NodesBySides)
    ->ArgName("sides")
    ->Arg(4)
    ->Arg(6)
    ->Arg(8)
    ->Arg(12)
    ->Arg(16)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(NodesByStarts)
    ->ArgName("starts")
    ->Arg(25)
    ->Arg(50)
    ->Arg(100)
    ->Arg(200)
    ->Arg(400)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(NodesByTolerances)
    ->ArgName("tolerances")
    ->Arg(0)
    ->Arg(1)
    ->Arg(2)
    ->Arg(5)
    ->Arg(10)
    ->Arg(20)
    ->Arg(50)
    ->Arg(100)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(Tolerances)
    ->ArgName("tolerances")
    ->Arg(0)
    ->Arg(10)
    ->Arg(20)
    ->Arg(50)
    ->Arg(kManyTolerances)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(Compared)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(Contacts)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(CheckDown, verdict, Margins::kNone)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(CheckDown, all_scales, Margins::kAll)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace assay::finemotion
