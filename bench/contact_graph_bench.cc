#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "bench/harness/contest.h"
#include "bench/workloads/pegs.h"
#include "planner/domain/problem/problem_file.h"
#include "planner/finemotion/contact_graph/contact_chain.h"
#include "planner/finemotion/contact_graph/contact_graph.h"
#include "planner/finemotion/contacts/contact_finder.h"
#include "planner/finemotion/strategy_search/mating.h"
#include "planner/geometry/pose.h"

namespace assay::finemotion {
namespace {

using workloads::BoxPiece;

constexpr double kHalf = 0.01;  // half of the peg's width, metres
constexpr double kHalfLength = 0.02;
constexpr double kClearance = 0.25e-3;  // metres on each side
constexpr double kReach = 0.005;

// Four slabs around a square hole through a block. A fifth slab closes the hole at the bottom.
Polyhedron Block() {
  constexpr double kIn = kHalf + kClearance;
  constexpr double kOut = 0.04;
  constexpr double kDeep = -0.03;
  return OutsideOf({BoxPiece({kIn, -kOut, kDeep}, {kOut, kOut, 0}),
                    BoxPiece({-kOut, -kOut, kDeep}, {-kIn, kOut, 0}),
                    BoxPiece({-kIn, kIn, kDeep}, {kIn, kOut, 0}),
                    BoxPiece({-kIn, -kOut, kDeep}, {kIn, -kIn, 0}),
                    BoxPiece({-kOut, -kOut, kDeep - 0.01}, {kOut, kOut, kDeep})});
}

// Returns what a square peg can touch with its lower end at this depth in the hole.
ContactSpace PegInHole(double depth) {
  const Polyhedron peg =
      OutsideOf({BoxPiece({-kHalf, -kHalf, -kHalfLength}, {kHalf, kHalf, kHalfLength})});
  return {PrimitiveContacts(peg, Block(), geometry::Translation(0, 0, kHalfLength - depth), 0.003)};
}

void Count(const ContactSpace& space, const ContactGraph& graph, benchmark::State& state) {
  state.counters["contacts"] = static_cast<double>(space.contacts.size());
  state.counters["states"] = static_cast<double>(graph.states.size());
  for (const ContactState& contact_state : graph.states) {
    state.counters[fmt::format("{}-D", contact_state.dimension)] += 1;
  }
}

void MakeGraph(const ContactSpace& space, const ContactGraphOptions& options,
               benchmark::State& state) {
  ContactGraph graph;
  for (auto _ : state) graph = MakeContactGraph(space, options);
  Count(space, graph, state);
}

// Times a critical point of the square peg with this number of target points.
void CriticalPoint(benchmark::State& state, double depth) {
  MakeGraph(PegInHole(depth),
            {.target_points = static_cast<int>(state.range(0)), .reach = kReach, .radius = 0.0245},
            state);
  // 12 is the paper's number of target points.
  if (state.range(0) == 12) state.counters["at_most_ms"] = 100;
}

// Times pegs with this number of sides at the rim. They have more contacts, each of a whole shape.
void Sides(benchmark::State& state) {
  const Passage passage = workloads::PegInHole(
      {.sides = static_cast<int>(state.range(0)), .half = kHalf, .length = 0.04}, kClearance);
  const ContactSpace space = {
      PrimitiveContacts(passage.moving, passage.stationary, passage.X_StationaryEntry, 0.003)};
  MakeGraph(space, {.reach = kReach, .radius = 0.0245}, state);
  state.SetComplexityN(static_cast<std::int64_t>(space.contacts.size()));
}

// Times the first contacts alone of the square peg at the rim.
void Contacts(benchmark::State& state) {
  ContactSpace space = PegInHole(0);
  space.contacts.resize(std::min(space.contacts.size(), static_cast<std::size_t>(state.range(0))));
  MakeGraph(space, {.reach = kReach, .radius = 0.0245}, state);
  state.SetComplexityN(state.range(0));
}

// Times the graphs of all critical points of a scenario's mating, as `assay mate` makes them.
void AllCriticalPoints(benchmark::State& state, const std::string& mating) {
  const std::string root = ASSAY_SOURCE_DIR;
  const domain::Problem problem = domain::ReadProblem(
      Document::Load(fmt::format("{}/scenarios/mate-{}.yaml", root, mating)), root + "/models");
  const MatingGeometry geometry = GeometryOf(problem, problem.matings.back());
  ContactChain chain;
  for (auto _ : state) chain = ContactChainOf(geometry);
  std::size_t contacts = 0, states = 0;
  for (const LocalTopology& point : chain.points) {
    contacts = std::max(contacts, point.space.contacts.size());
    states += point.graph.states.size();
  }
  state.counters["graphs"] = static_cast<double>(chain.points.size());
  state.counters["most_contacts"] = static_cast<double>(contacts);
  state.counters["states"] = static_cast<double>(states);
}
BENCHMARK_CAPTURE(CriticalPoint, at_the_rim, 0.0)
    ->ArgName("target_points")
    ->Arg(3)
    ->Arg(6)
    ->Arg(12)
    ->Arg(24)
    ->Arg(48)
    ->Arg(96)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(CriticalPoint, past_the_rim, 0.001)
    ->ArgName("target_points")
    ->Arg(12)
    ->Arg(24)
    ->Arg(48)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(CriticalPoint, half_in, 0.015)
    ->ArgName("target_points")
    ->Arg(12)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(CriticalPoint, at_the_bottom, 0.03)
    ->ArgName("target_points")
    ->Arg(6)
    ->Arg(12)
    ->Arg(24)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(Sides)
    ->ArgName("sides")
    ->Arg(4)
    ->Arg(6)
    ->Arg(8)
    ->Arg(12)
    ->Unit(benchmark::kMillisecond)
    ->Complexity();
BENCHMARK(Contacts)
    ->ArgName("contacts")
    ->DenseRange(4, 32, 4)
    ->Unit(benchmark::kMillisecond)
    ->Complexity();

const bool kAdded = [] {
  for (const char* mating : {"square", "keyed", "octagonal", "stepped", "t-slot"}) {
    const std::string name = mating;
    if (bench::Tiny() && name != "square") continue;
    benchmark::RegisterBenchmark(
        ("AllCriticalPoints/" + name).c_str(),
        [name](benchmark::State& state) { AllCriticalPoints(state, name); })
        ->Unit(benchmark::kMillisecond);
  }
  return true;
}();

}  // namespace
}  // namespace assay::finemotion
