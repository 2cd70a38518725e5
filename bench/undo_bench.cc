// Measures the cost of undoing with the marks that a planner sets before a choice. In
// labeling_bench's traces, in contrast, the network itself takes back a refused arc.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <chrono>
#include <string>

#ifdef ASSAY_PEER_GECODE_LABELING
#include "bench/peers/gecode_labeling.h"
#endif
#include "bench/harness/contest.h"
#include "bench/workloads/networks.h"

namespace assay::network {
namespace {

using workloads::NetworkFamily;
using workloads::NetworkWorkload;

constexpr int kMostParts = 7;
[[maybe_unused]] constexpr double kPeerSeconds = 10;
// The least measured time of very short work. In a shorter time the first iteration would dominate.
constexpr double kSeconds = 0.02;

// Returns the index of the plan with this many parts and as many threats as are usual among the
// benchmarks' plans.
int IndexOf(int parts) { return 5 * (parts - 2) + 2; }

NetworkWorkload Plan(int parts) {
  return workloads::NetworkOfFamily(NetworkFamily::kPlan, IndexOf(parts), bench::Seed());
}
NetworkWorkload Plan(const benchmark::State& state) {
  return Plan(static_cast<int>(state.range(0)));
}

// Returns a network with the plan's nodes, and its arcs without the last ones.
Network Posted(const NetworkWorkload& plan, std::size_t left_out) {
  Network network;
  for (const LabelSet& labels : plan.nodes) network.AddNode(labels);
  for (std::size_t i = 0; i + left_out < plan.arcs.size(); ++i) {
    network.Post(plan.arcs[i].a, plan.arcs[i].b, plan.arcs[i].relation);
  }
  return network;
}

// Times a mark and the return to it, in a network that holds the whole plan.
void SaveAndUndo(benchmark::State& state) {
  const NetworkWorkload plan = Plan(state);
  Network network = Posted(plan, 0);
  for (auto _ : state) network.Undo(network.Save());
  state.counters["arcs"] = static_cast<double>(network.arcs().size());
}

void PostAll(Network& network, const NetworkWorkload& plan) {
  for (const Arc& arc : plan.arcs) network.Post(arc.a, arc.b, arc.relation);
}

// Times a mark, posting all arcs one by one with an answer each, and the return to the mark. The
// return has a counter of its own. Nothing is searched, since the labelings that were found the
// first time still hold.
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

BENCHMARK(SaveAndUndo)->ArgName("parts")->DenseRange(2, kMostParts)->MinTime(kSeconds);
BENCHMARK(PostAllAndUndo)
    ->ArgName("parts")
    ->DenseRange(2, kMostParts)
    ->MinTime(kSeconds)
    ->Unit(benchmark::kMicrosecond);

// Times a mark, the last arc with its answer, and the return to the mark.
void TryLastArc(benchmark::State& state, int parts) {
  const NetworkWorkload plan = Plan(parts);
  Network network = Posted(plan, 1);
  const Arc& last = plan.arcs.back();
  Outcome outcome = Outcome::kNone;
  for (auto _ : state) {
    const Network::Mark mark = network.Save();
    outcome = network.Post(last.a, last.b, last.relation);
    network.Undo(mark);
  }
  if (outcome != plan.Build().Decide()) state.SkipWithError("the wrong answer");
  state.counters["arcs"] = static_cast<double>(plan.arcs.size());
}

#ifdef ASSAY_PEER_GECODE_LABELING
using peers::GecodeLabeling;

void GecodeTriesLastArc(benchmark::State& state, int parts, GecodeLabeling::Order order) {
  const NetworkWorkload plan = Plan(parts);
  const GecodeLabeling gecode(plan);
  const auto ask = gecode.AskForLastArc(order, kPeerSeconds);
  Outcome outcome = Outcome::kNone;
  for (auto _ : state) outcome = ask();
  state.counters[bench::kTimeout] = outcome == Outcome::kBudget;
  if (outcome != Outcome::kBudget && outcome != plan.Build().Decide()) {
    state.SkipWithError("its answer is not that of assay");
  }
}
#endif

void AddTrying(int parts) {
  const std::string instance = fmt::format("plan-{:02}", IndexOf(parts));
  bench::AddContestant(
      "trying-an-arc", instance, "assay",
      [=](benchmark::State& state) { TryLastArc(state, parts); }, kSeconds);
#ifdef ASSAY_PEER_GECODE_LABELING
  for (const GecodeLabeling::Order order : GecodeLabeling::kOrders) {
    bench::AddContestant("trying-an-arc", instance, GecodeLabeling::Name(order),
                         [=](benchmark::State& state) { GecodeTriesLastArc(state, parts, order); });
  }
#endif
}

const bool kAdded = [] {
  bench::Announce("trying-an-arc",
                  {.measured = "one more arc in a network that has the rest of a plan. assay saves "
                               "its network, posts the arc, answers and undoes the arc. Gecode "
                               "clones its space, posts the arc, searches and drops the clone",
                   .unfair = "assay still has a labeling that satisfies the arc, as is mostly the "
                             "case in a planner's network. Gecode keeps no labeling, and its clone "
                             "also copies what does not change",
                   .against = "gecode"});
#ifndef ASSAY_PEER_GECODE_LABELING
  bench::AddMissing("trying-an-arc", "gecode", "libgecode-dev");
#endif
  for (int parts = 2; parts <= (bench::Tiny() ? 2 : kMostParts); ++parts) AddTrying(parts);
  return true;
}();

}  // namespace
}  // namespace assay::network
