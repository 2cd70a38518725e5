#include <benchmark/benchmark.h>

#include <limits>

#include "bench/workloads/networks.h"
#include "planner/base/check.h"
#include "planner/network/count.h"
#include "planner/network/search.h"

namespace assay::network {
namespace {

using workloads::NetworkWorkload;

Budget Enough() { return Budget(std::numeric_limits<std::int64_t>::max()); }

NetworkWorkload HardNetwork(int nodes) {
  RandomStream random(1, "hard");
  return workloads::RandomNetwork(
      {.nodes = nodes, .labels = 10, .arcs = nodes * 5, .forbidden = 37}, random);
}

NetworkWorkload PlanNetwork(int parts) {
  RandomStream random(1, "plan");
  return workloads::RandomPlanNetwork({.parts = parts, .steps = 3}, random);
}

void Report(benchmark::State& state, const Counters& counters) {
  state.counters["visited"] = static_cast<double>(counters.visited);
  state.counters["revisions"] = static_cast<double>(counters.revisions);
}

void DecideWorkload(benchmark::State& state, const NetworkWorkload& workload) {
  const Network network = workload.Build();
  Counters counters;
  for (auto _ : state) {
    Budget budget = Enough();
    counters = First(network, {}, budget).counters;
  }
  Report(state, counters);
}

void FirstLabelingOfHardNetwork(benchmark::State& state) {
  DecideWorkload(state, HardNetwork(static_cast<int>(state.range(0))));
}
BENCHMARK(FirstLabelingOfHardNetwork)->Arg(20)->Arg(30)->Arg(40);

void FirstLabelingOfPlanNetwork(benchmark::State& state) {
  DecideWorkload(state, PlanNetwork(static_cast<int>(state.range(0))));
}
BENCHMARK(FirstLabelingOfPlanNetwork)->Arg(2)->Arg(4)->Arg(8)->Arg(16);

void CountOfPlanNetwork(benchmark::State& state) {
  const Network network = PlanNetwork(static_cast<int>(state.range(0))).Build();
  LabelingCount count;
  for (auto _ : state) {
    Budget budget = Enough();
    count = Count(network, budget);
  }
  Report(state, count.counters);
}
BENCHMARK(CountOfPlanNetwork)->Arg(2)->Arg(3);

// A planner's use: arc after arc, with an answer after each; what is refused is left out.
void PostArcByArc(benchmark::State& state) {
  const NetworkWorkload workload = PlanNetwork(static_cast<int>(state.range(0)));
  Counters counters;
  int refused = 0;
  for (auto _ : state) {
    Network network;
    refused = 0;
    for (const LabelSet& labels : workload.nodes) network.AddNode(labels);
    for (const Arc& arc : workload.arcs) {
      if (network.Post(arc.a, arc.b, arc.relation) != Outcome::kFound) ++refused;
    }
    counters = network.counters();
  }
  Report(state, counters);
  state.counters["refused"] = refused;
}
BENCHMARK(PostArcByArc)->Arg(2)->Arg(4)->Arg(8)->Arg(16);

}  // namespace
}  // namespace assay::network
