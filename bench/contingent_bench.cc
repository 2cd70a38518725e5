#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <limits>
#include <set>
#include <utility>

#include "planner/base/check.h"
#include "planner/contingent/contingent_planner.h"
#include "planner/contingent/grounding.h"
#include "planner/contingent/pks_file.h"
#include "planner/contingent/task_file.h"

namespace assay::contingent {
namespace {

// Reads, grounds and plans; what came of it as counters.
void PlanTask(benchmark::State& state, const std::function<Task()>& read) {
  ContingentPlan plan;
  for (auto _ : state) {
    const Task task = read();
    Externs externs;
    const GroundTask ground = Ground(task.domain, task.problem, externs);
    Budget budget(std::numeric_limits<std::int64_t>::max());
    plan = MakePlan(ground, Wanted::kFirst, budget);
    ASSAY_CHECK(plan.outcome == Outcome::kFound);
  }
  const TreeSize size = SizeOf(plan.tree);
  state.counters["actions"] = size.actions;
  state.counters["nodes"] = size.nodes;
  state.counters["depth"] = size.depth;
  state.counters["leaves"] = size.leaves;
  state.counters["states"] = static_cast<double>(plan.states);
}

Problem Cans(int count) {
  std::string objects = "can1";
  for (int can = 2; can <= count; ++can) objects += fmt::format(", can{}", can);
  return ReadPksProblem(
      fmt::format("problem cans domain force-sensing objects: {}: object "
                  "init: add(Kf, handEmpty), add(LCW, isGrasped(?o)), add(LCW, isRemoved(?o)) "
                  "goal: forallK(?o: object) (K(isRemoved(?o)) & K(!isGrasped(?o)))",
                  objects),
      "cans.pks");
}

void ForceSensing(benchmark::State& state) {
  const std::string file = ASSAY_SOURCE_DIR "/scenarios/know/force-sensing.pks";
  PlanTask(state, [&] {
    return Task{ReadPksDomain(TextOfFile(file), file), Cans(static_cast<int>(state.range(0)))};
  });
  if (state.range(0) == 10) state.counters["at_most_ms"] = 10;
}
BENCHMARK(ForceSensing)
    ->ArgName("cans")
    ->RangeMultiplier(2)
    ->Range(2, 64)
    ->Arg(10)
    ->Unit(benchmark::kMillisecond);

// What PO-PRP, the strongest planner that could be built, took on another machine of this kind:
// seconds of its search alone, and state-action pairs of its policy; 0: it refuses the problem, or
// finds nothing in 120 s.
struct PublishedFigure {
  const char* problem;
  double search = 0;
  double pairs = 0;
};
constexpr PublishedFigure kPoPrp[] = {
    {"kvp-force-2", 0.03, 11}, {"kvp-force-10", 0.08, 51}, {"kvp-visual-6", 0.06, 43},
    {"med-30", 0.06, 90},      {"med-99", 0.7, 297},       {"doors5", 0.06, 68},
    {"doors9", 1.4, 277},      {"doors11", 34, 461},       {"ebtcs-70", 0.3, 280},
    {"wumpus05", 0.12, 309},   {"wumpus07", 1.4, 1724},    {"wumpus10", 14.7, 4400},
    {"unix4", 0.3, 416}};

// Milliseconds that are wanted.
constexpr std::pair<const char*, double> kWanted[] = {
    {"kvp-force-10", 10}, {"doors11", 1000}, {"wumpus10", 1000}};

void PlanProblem(benchmark::State& state, const std::filesystem::path& folder) {
  PlanTask(state, [&] { return LoadTask(folder / "d.pddl", folder / "p.pddl"); });
  const std::string name = folder.filename().string();
  for (const PublishedFigure& figure : kPoPrp) {
    if (figure.problem != name) continue;
    state.counters["po_prp_search_ms"] = 1000 * figure.search;
    state.counters["po_prp_pairs"] = figure.pairs;
  }
  for (const auto& [problem, wanted] : kWanted) {
    if (problem == name) state.counters["at_most_ms"] = wanted;
  }
}

void AddProblems(const std::filesystem::path& folder) {
  std::set<std::filesystem::path> problems;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (std::filesystem::exists(entry.path() / "d.pddl")) problems.insert(entry.path());
  }
  for (const std::filesystem::path& problem : problems) {
    benchmark::RegisterBenchmark(
        ("Contingent/" + problem.filename().string()).c_str(),
        [problem](benchmark::State& state) { PlanProblem(state, problem); })
        ->Unit(benchmark::kMillisecond);
  }
}

// The benchmark problems of others are not here: ASSAY_CONTINGENT names a folder with a folder for
// each of them, of d.pddl and p.pddl.
const bool kAdded = [] {
  AddProblems(ASSAY_SOURCE_DIR "/bench/workloads/contingent");
  if (const char* const folder = std::getenv("ASSAY_CONTINGENT")) AddProblems(folder);
  return true;
}();

}  // namespace
}  // namespace assay::contingent
