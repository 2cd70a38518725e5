#include <benchmark/benchmark.h>

#include <algorithm>
#include <numbers>

#include "planner/finemotion/strategy_search.h"
#include "tests/planner/finemotion/boxes.h"

namespace assay::finemotion {
namespace {

constexpr double kHalf = 0.01905;       // of the peg's width, metres
constexpr double kClearance = 0.25e-3;  // on each side
constexpr double kReach = 0.012;
constexpr double kTurn = 0.03;  // radians

Passage SquarePegInHole() {
  Passage passage;
  passage.moving = BoxShape({-kHalf, -kHalf, 0}, {kHalf, kHalf, 0.07});
  passage.stationary = SquareHoleShape(kHalf + kClearance, 0.038, 0.07);
  return passage;
}

// Multiples of 2 mm and 1 degree, in all six dimensions.
FineMotionErrors ErrorsOf(double multiple) {
  FineMotionErrors errors;
  errors.pose << Vector3::Constant(2e-3), Vector3::Constant(std::numbers::pi / 180);
  errors.pose *= multiple;
  return errors;
}

// A tilted peg, its lowest corner on the face beside the hole.
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
  state.counters["found"] = plan.found ? 1 : 0;
  state.counters["absorbed"] = plan.absorbed;
  state.counters["motions"] = static_cast<double>(plan.motions.size());
  state.counters["nodes"] = plan.expanded;
  state.counters["replayed"] = plan.replayed;
}

// So many tolerances, of each face of peg and hole in turn; together a twentieth of the play at a
// face.
void Tolerances(benchmark::State& state) {
  Passage passage = SquarePegInHole();
  const auto count = static_cast<int>(state.range(0));
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
  FineMotionErrors errors = ErrorsOf(1);
  const int on_each_face = (count + faces - 1) / faces;
  errors.tolerances.setConstant(count, 0.05 * kClearance / std::max(1, on_each_face));
  FineMotionPlan plan;
  for (auto _ : state) plan = SearchStrategy(passage, errors, {.seed = 3});
  state.counters["found"] = plan.found ? 1 : 0;
  state.counters["absorbed"] = plan.absorbed;
  state.counters["nodes"] = plan.expanded;
  state.counters["replayed"] = plan.replayed;
}

// How often the paper's edge test would have answered otherwise.
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

void CheckDown(benchmark::State& state, bool whole) {
  const Passage passage = SquarePegInHole();
  const auto contacts =
      PrimitiveContacts(passage.moving, passage.stationary, OnTheFace(), kReach, {}, kTurn);
  GeneralizedPoint down = GeneralizedPoint::Zero(kPoseDimensions);
  down.z() = -0.01;
  const Command command = {down, {}, ContactKey{ContactKind::kVertexFace, 0, 0}};
  const Belief belief = {Displaced(OnTheFace(), -down), ErrorsOf(1).pose.asDiagonal()};
  SegmentCheck check;
  for (auto _ : state) check = Check({contacts, 0.002, 0.02}, belief, command, whole);
  state.counters["contacts"] = static_cast<double>(contacts.size());
  state.counters["certain"] = check.certain ? 1 : 0;
  state.counters["unwanted"] = static_cast<double>(check.unwanted.size());
}

BENCHMARK_CAPTURE(Search, half_errors, 0.5)
    ->ArgName("seed")
    ->DenseRange(1, 3)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Search, all_errors, 1.0)
    ->ArgName("seed")
    ->DenseRange(1, 3)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(Tolerances)
    ->ArgName("tolerances")
    ->Arg(0)
    ->Arg(10)
    ->Arg(20)
    ->Arg(50)
    ->Arg(100)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(Compared)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(Contacts)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(CheckDown, verdict, false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(CheckDown, all_scales, true)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace assay::finemotion
