// What taking back costs, apart from labeling_bench's traces, where a refused arc is taken back by
// the network itself: the marks that a planner sets before a choice.

#include <benchmark/benchmark.h>

#include <chrono>

#include "bench/harness/contest.h"
#include "bench/workloads/networks.h"

namespace assay::network {
namespace {

using workloads::NetworkFamily;
using workloads::NetworkWorkload;

// The plan of so many parts, with as many threats as is usual among the benchmarks' plans.
NetworkWorkload Plan(const benchmark::State& state) {
  const int index = 5 * (static_cast<int>(state.range(0)) - 2) + 2;
  return workloads::NetworkOfFamily(NetworkFamily::kPlan, index, bench::Seed());
}

// Its nodes, and its arcs but for the last ones.
Network Posted(const NetworkWorkload& plan, std::size_t left_out) {
  Network network;
  for (const LabelSet& labels : plan.nodes) network.AddNode(labels);
  for (std::size_t i = 0; i + left_out < plan.arcs.size(); ++i) {
    network.Post(plan.arcs[i].a, plan.arcs[i].b, plan.arcs[i].relation);
  }
  return network;
}

// A mark, and back to it, in a network that holds the whole plan.
void SaveAndUndo(benchmark::State& state) {
  const NetworkWorkload plan = Plan(state);
  Network network = Posted(plan, 0);
  for (auto _ : state) network.Undo(network.Save());
  state.counters["arcs"] = static_cast<double>(network.arcs().size());
}

// A mark, one arc with its answer, and back.
void PostOneAndUndo(benchmark::State& state) {
  const NetworkWorkload plan = Plan(state);
  Network network = Posted(plan, 1);
  const Arc& last = plan.arcs.back();
  for (auto _ : state) {
    const Network::Mark mark = network.Save();
    benchmark::DoNotOptimize(network.Post(last.a, last.b, last.relation));
    network.Undo(mark);
  }
  state.counters["arcs"] = 1;
}

void PostAll(Network& network, const NetworkWorkload& plan) {
  for (const Arc& arc : plan.arcs) network.Post(arc.a, arc.b, arc.relation);
}

// A mark, all arcs one by one, each with its answer, and back at once; how long that takes is
// counted by itself. Nothing is searched any more: what was found the first time still holds.
void PostAllAndUndo(benchmark::State& state) {
  using Clock = std::chrono::steady_clock;
  const NetworkWorkload plan = Plan(state);
  Network network = Posted(plan, plan.arcs.size());
  const Network::Mark nothing_posted = network.Save();
  PostAll(network, plan);
  network.Undo(nothing_posted);
  Clock::duration undoing{};
  for (auto _ : state) {
    const Network::Mark mark = network.Save();
    PostAll(network, plan);
    const Clock::time_point posted = Clock::now();
    network.Undo(mark);
    undoing += Clock::now() - posted;
  }
  state.counters["arcs"] = static_cast<double>(plan.arcs.size());
  state.counters["undo_us"] =
      benchmark::Counter(std::chrono::duration<double, std::micro>(undoing).count(),
                         benchmark::Counter::kAvgIterations);
}

// What is so short that in less time the first iteration would tell.
constexpr double kSeconds = 0.02;

BENCHMARK(SaveAndUndo)->ArgName("parts")->DenseRange(2, 7)->MinTime(kSeconds);
BENCHMARK(PostOneAndUndo)->ArgName("parts")->DenseRange(2, 7)->MinTime(kSeconds);
BENCHMARK(PostAllAndUndo)
    ->ArgName("parts")
    ->DenseRange(2, 7)
    ->MinTime(kSeconds)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace assay::network
