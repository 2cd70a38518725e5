// Compares assay's labeling engine with Gecode, CaDiCaL and Z3, on the same networks in one run:
//   labeling/NETWORK/CONTESTANT   the first labeling, or the proof that there is none
//   counting/NETWORK/CONTESTANT   the number of labelings
//   posting/NETWORK/CONTESTANT    arcs posted one by one, each with a complete answer whether a
//                                 labeling is left, and taken back where none is
//
// For labeling and counting, the time runs from a network in the contestant's own form to the
// answer. Assay searches its network. Gecode posts its tables, which cannot be separated from their
// propagation, and searches. CaDiCaL and Z3 solve their clauses. Reading files, drawing random
// networks, and making arcs, tables and clauses of these networks is excluded; "assay:built"
// includes building a network of nodes and arcs. For posting, everything counts except the making
// of relations and tables.
//
// A contestant's answer is compared with assay's before its time counts.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#ifdef ASSAY_PEER_CADICAL_LABELING
#include "bench/peers/cadical_labeling.h"
#endif
#ifdef ASSAY_PEER_GECODE_LABELING
#include "bench/peers/gecode_labeling.h"
#endif
#ifdef ASSAY_PEER_Z3_LABELING
#include "bench/peers/z3_labeling.h"
#endif
#include "bench/harness/contest.h"
#include "bench/peers/labeling_answer.h"
#include "bench/workloads/networks.h"
#include "planner/network/labeling/count.h"
#include "planner/network/labeling/search.h"

namespace assay::network {
namespace {

using workloads::NetworkWorkload;

// The limit of a peer for one question, and for all questions of one trace.
constexpr double kPeerSeconds = 10;
// Z3 is the slowest peer. With a greater limit it would take most of a pass.
constexpr double kZ3Seconds = 2;

// The least time that a solver of clauses is measured for in a pass. Making the clauses, which is
// not timed, takes up to a hundred times as long as solving them.
constexpr double kSolverSeconds = 1e-3;

// A network, drawn or read when it is first needed, and assay's answers about it.
class Instance {
 public:
  explicit Instance(std::function<NetworkWorkload()> make) : make_(std::move(make)) {}

  const NetworkWorkload& workload() { return Once(workload_, make_); }
  Outcome outcome() {
    return Once(outcome_, [&] { return workload().Build().Decide(); });
  }
  std::uint64_t count() {
    Budget budget(std::numeric_limits<std::int64_t>::max());
    return Once(count_, [&] { return Count(workload().Build(), budget).count; });
  }
  const std::vector<Outcome>& posts() {
    return Once(posts_, [&] { return workloads::PostArcByArc(workload()).outcomes; });
  }

 private:
  template <class T, class Make>
  static const T& Once(std::optional<T>& value, const Make& make) {
    if (!value.has_value()) value = make();
    return *value;
  }

  std::function<NetworkWorkload()> make_;
  std::optional<NetworkWorkload> workload_;
  std::optional<Outcome> outcome_;
  std::optional<std::uint64_t> count_;
  std::optional<std::vector<Outcome>> posts_;
};

struct Contestant {
  std::string name;
  std::function<void(benchmark::State&, Instance&)> measure;
  double least_seconds = bench::kAsAsked;
};
using Contestants = std::vector<Contestant>;

// ---- Answers ----------------------------------------------------------------------------------

enum class Verdict { kAgrees, kDiffers, kTimeIsUp };

Verdict Judge(Instance& instance, const peers::LabelingAnswer& answer) {
  if (answer.outcome == Outcome::kBudget) return Verdict::kTimeIsUp;
  const bool agrees =
      answer.outcome == instance.outcome() &&
      (answer.outcome != Outcome::kFound || instance.workload().Build().Satisfies(answer.labeling));
  return agrees ? Verdict::kAgrees : Verdict::kDiffers;
}

[[maybe_unused]] Verdict Judge(Instance& instance, const peers::CountAnswer& answer) {
  if (answer.outcome == Outcome::kBudget) return Verdict::kTimeIsUp;
  return answer.count == instance.count() ? Verdict::kAgrees : Verdict::kDiffers;
}

[[maybe_unused]] Verdict Judge(Instance& instance, const std::vector<Outcome>& posts) {
  if (posts.size() < instance.workload().arcs.size()) return Verdict::kTimeIsUp;
  return posts == instance.posts() ? Verdict::kAgrees : Verdict::kDiffers;
}

// ---- Assay ------------------------------------------------------------------------------------

void Report(benchmark::State& state, Instance& instance, const Counters& counters) {
  state.counters["size"] = static_cast<double>(instance.workload().nodes.size());
  state.counters["visited"] = static_cast<double>(counters.visited);
  state.counters["revisions"] = static_cast<double>(counters.revisions);
}

void Label(benchmark::State& state, Instance& instance) {
  const Network network = instance.workload().Build();
  FirstLabeling first;
  for (auto _ : state) {
    Budget budget(std::numeric_limits<std::int64_t>::max());
    first = First(network, {}, budget);
  }
  Report(state, instance, first.counters);
  state.counters["found"] = first.outcome == Outcome::kFound;
  if (Judge(instance, {.outcome = first.outcome, .labeling = first.labeling}) != Verdict::kAgrees) {
    state.SkipWithError("a refutation or a labeling that does not hold");
  }
}

void BuildAndLabel(benchmark::State& state, Instance& instance) {
  const NetworkWorkload& workload = instance.workload();
  for (auto _ : state) {
    Budget budget(std::numeric_limits<std::int64_t>::max());
    benchmark::DoNotOptimize(First(workload.Build(), {}, budget));
  }
}

void CountAll(benchmark::State& state, Instance& instance) {
  const Network network = instance.workload().Build();
  LabelingCount count;
  for (auto _ : state) {
    Budget budget(std::numeric_limits<std::int64_t>::max());
    count = Count(network, budget);
  }
  Report(state, instance, count.counters);
  state.counters["count"] = static_cast<double>(count.count);
}

void Post(benchmark::State& state, Instance& instance) {
  const NetworkWorkload& workload = instance.workload();
  workloads::Posts posts;
  for (auto _ : state) posts = workloads::PostArcByArc(workload);
  Report(state, instance, posts.counters);
  const auto refused = std::ranges::count(posts.outcomes, Outcome::kNone);
  state.counters["arcs"] = static_cast<double>(posts.outcomes.size());
  state.counters["refused"] = static_cast<double>(refused);
  if (refused > 0) state.SetLabel("some refused");
}

// ---- Peers ------------------------------------------------------------------------------------

void Conclude(benchmark::State& state, Verdict verdict) {
  state.counters[bench::kTimeout] = verdict == Verdict::kTimeIsUp;
  if (verdict == Verdict::kDiffers) state.SkipWithError("its answer is not that of assay");
}

// Measures `ask`, which starts anew each time.
template <class Ask>
void Measure(benchmark::State& state, Instance& instance, const Ask& ask) {
  decltype(ask()) answer;
  for (auto _ : state) answer = ask();
  Conclude(state, Judge(instance, answer));
}

#ifdef ASSAY_PEER_GECODE_LABELING
using peers::GecodeLabeling;

// Returns one contestant for each of Gecode's variable orders.
template <class Ask>
Contestants Gecode(const Ask& ask) {
  Contestants contestants;
  for (const GecodeLabeling::Order order : GecodeLabeling::kOrders) {
    contestants.push_back({std::string(GecodeLabeling::Name(order)),
                           [=](benchmark::State& state, Instance& instance) {
                             const GecodeLabeling gecode(instance.workload());
                             Measure(state, instance, [&] { return ask(gecode, order); });
                           }});
  }
  return contestants;
}

Contestants GecodeLabels() {
  return Gecode([](const GecodeLabeling& gecode, GecodeLabeling::Order order) {
    return gecode.First(order, kPeerSeconds);
  });
}

Contestants GecodeCounts() {
  Contestants contestants = Gecode([](const GecodeLabeling& gecode, GecodeLabeling::Order order) {
    return gecode.Count(order, kPeerSeconds);
  });
  std::erase_if(contestants, [](const Contestant& contestant) {
    return contestant.name == GecodeLabeling::Name(GecodeLabeling::Order::kAfcRestarts);
  });
  return contestants;
}

Contestants GecodePosts() {
  return Gecode([](const GecodeLabeling& gecode, GecodeLabeling::Order order) {
    return gecode.PostArcByArc(order, kPeerSeconds);
  });
}
#else
Contestants GecodeLabels() { return {}; }
Contestants GecodeCounts() { return {}; }
Contestants GecodePosts() { return {}; }
#endif

// Measures a solver that answers once. A new solver gets the clauses while the clock is stopped.
// Stopping and starting the clock costs less than a microsecond.
template <class Solver>
void MeasureSolver(benchmark::State& state, Instance& instance, typename Solver::Encoding encoding,
                   double seconds) {
  std::optional<Solver> solver;
  peers::LabelingAnswer answer;
  for (auto _ : state) {
    state.PauseTiming();
    solver.emplace(instance.workload(), encoding);
    state.ResumeTiming();
    answer = solver->First(seconds);
  }
  Conclude(state, Judge(instance, answer));
}

// Returns one contestant for each encoding of a solver of clauses.
template <class Solver>
Contestants SolverLabels(double seconds) {
  Contestants contestants;
  for (const auto encoding : Solver::kEncodings) {
    contestants.push_back({std::string(Solver::Name(encoding)),
                           [=](benchmark::State& state, Instance& instance) {
                             MeasureSolver<Solver>(state, instance, encoding, seconds);
                           },
                           kSolverSeconds});
  }
  return contestants;
}

template <class Solver>
Contestants SolverPosts(double seconds) {
  Contestants contestants;
  for (const auto encoding : Solver::kEncodings) {
    contestants.push_back(
        {std::string(Solver::Name(encoding)), [=](benchmark::State& state, Instance& instance) {
           Measure(state, instance,
                   [&] { return Solver::PostArcByArc(instance.workload(), encoding, seconds); });
         }});
  }
  return contestants;
}

#ifdef ASSAY_PEER_CADICAL_LABELING
Contestants CadicalLabels() { return SolverLabels<peers::CadicalLabeling>(kPeerSeconds); }
Contestants CadicalPosts() { return SolverPosts<peers::CadicalLabeling>(kPeerSeconds); }
#else
Contestants CadicalLabels() { return {}; }
Contestants CadicalPosts() { return {}; }
#endif

#ifdef ASSAY_PEER_Z3_LABELING
Contestants Z3Labels() { return SolverLabels<peers::Z3Labeling>(kZ3Seconds); }
Contestants Z3Posts() { return SolverPosts<peers::Z3Labeling>(kZ3Seconds); }
#else
Contestants Z3Labels() { return {}; }
Contestants Z3Posts() { return {}; }
#endif

// ---- Contestants and networks -------------------------------------------------------------------

Contestants Beside(Contestant ours, std::initializer_list<Contestants> peers) {
  Contestants contestants = {std::move(ours)};
  for (const Contestants& some : peers) {
    contestants.insert(contestants.end(), some.begin(), some.end());
  }
  return contestants;
}

void Add(std::string_view family, const std::string& name,
         const std::shared_ptr<Instance>& instance, const Contestants& contestants) {
  for (const Contestant& contestant : contestants) {
    bench::AddContestant(
        family, name, contestant.name,
        [=](benchmark::State& state) { contestant.measure(state, *instance); },
        contestant.least_seconds);
  }
}

void AddLabelingAndCounting(const workloads::MeasuredNetwork& network,
                            const std::shared_ptr<Instance>& instance) {
  Add("labeling", network.name, instance,
      Beside({"assay", Label},
             {{{"assay:built", BuildAndLabel}}, GecodeLabels(), CadicalLabels(), Z3Labels()}));
  if (!network.is_countable) return;
  Add("counting", network.name, instance, Beside({"assay", CountAll}, {GecodeCounts()}));
}

void AddPosting(const std::string& name, const std::shared_ptr<Instance>& instance) {
  Add("posting", name, instance,
      Beside({"assay", Post}, {GecodePosts(), CadicalPosts(), Z3Posts()}));
}

void AddNetworks() {
  for (const workloads::MeasuredNetwork& network : workloads::MeasuredNetworks(
           ASSAY_SOURCE_DIR "/bench/workloads/networks", bench::Seed(),
           bench::Tiny() ? workloads::Extent::kTiny : workloads::Extent::kWhole)) {
    const auto instance = std::make_shared<Instance>(network.make);
    AddLabelingAndCounting(network, instance);
    if (network.is_plan) AddPosting(network.name, instance);
  }
}

// Adds the traces of plans whose parts are in each other's way, so that arcs are refused and taken
// back.
void AddCrowdedPlans() {
  const int traces = bench::Tiny() ? 1 : workloads::kNetworksOfFamily;
  for (int index = 0; index < traces; ++index) {
    AddPosting(fmt::format("crowded-{:02}", index), std::make_shared<Instance>([=] {
                 return workloads::CrowdedPlan(index, bench::Seed());
               }));
  }
}

void AddLargePlans() {
  if (bench::Tiny()) return;
  for (const workloads::PlanSize size : workloads::kLargePlans) {
    for (int index = 0; index < 3; ++index) {
      const std::string which = fmt::format("{}x{}-{:02}", size.parts, size.steps, index);
      AddPosting("large-" + which, std::make_shared<Instance>([=] {
                   return workloads::LargeThreatenedPlan(size, index, bench::Seed());
                 }));
      AddPosting("crowded-" + which, std::make_shared<Instance>([=] {
                   return workloads::LargeCrowdedPlan(size, index, bench::Seed());
                 }));
    }
  }
}

void AnnounceFamilies() {
  const std::string general =
      "CaDiCaL and Z3 are general solvers, and are built for the oldest processors of the "
      "architecture. No contestant gets more than " +
      fmt::format("{} s, Z3 {} s of the wall clock", kPeerSeconds, kZ3Seconds);
  bench::Announce(
      "labeling",
      {.measured = "the first labeling, or the proof that there is none, from the contestant's own "
                   "form of the network. assay searches its network, Gecode posts its tables and "
                   "searches, CaDiCaL and Z3 solve clauses",
       .unfair = "Gecode's posting cannot be separated from its first propagation, so its time "
                 "counts. The contestant built also builds the network of assay each time. Each "
                 "question is repeated many times in a row, which suits caches and branch "
                 "prediction. In the section labeling-in-turn the questions take turns. " +
                 general,
       .against = "gecode",
       .at_least = 20,
       .never_below = 1 / 1.1});
  bench::Announce(
      "counting",
      {.measured = "the number of all labelings",
       .unfair =
           "Gecode lists the labelings one by one. assay multiplies the counts of parts of the "
           "network that do not depend on each other. Networks of plans, trees and grids, and of "
           "the files easy-n200-d5 and grid-n100-d20, are left out, because they have more "
           "labelings than can be listed. In the section counting-in-turn the questions take turns",
       .against = "gecode",
       .at_least = 10});
  bench::Announce(
      "posting",
      {.measured = "a whole trace. Arcs are posted one by one. Each arc gets a complete answer, "
                   "and is retracted if it leaves no labeling",
       .unfair = "Gecode clones a space with the accepted arcs and searches it anew. CaDiCaL and "
                 "Z3 keep what they have learned. The time for adding clauses counts, as does the "
                 "time for adding arcs to the network of assay. Plans of 30 to 60 parts in 5 steps "
                 "in which 8 to 10 % of the poses interfere are left out. If the first refusals in "
                 "such a plan are hard, CaDiCaL is up to 14 times as fast as assay. " +
                 general,
       .against = "gecode",
       .at_least = 50,
       .never_below = 1});
}

void AnnounceMissing() {
#ifndef ASSAY_PEER_GECODE_LABELING
  for (const char* family : {"labeling", "counting", "posting"}) {
    bench::AddMissing(family, "gecode", "libgecode-dev");
  }
#endif
  for ([[maybe_unused]] const char* family : {"labeling", "posting"}) {
#ifndef ASSAY_PEER_CADICAL_LABELING
    bench::AddMissing(family, "cadical", "libcadical-dev");
#endif
#ifndef ASSAY_PEER_Z3_LABELING
    bench::AddMissing(family, "z3", "libz3-dev");
#endif
  }
}

const bool kAdded = [] {
  AnnounceFamilies();
  AnnounceMissing();
  AddNetworks();
  AddCrowdedPlans();
  AddLargePlans();
  return true;
}();

}  // namespace
}  // namespace assay::network
