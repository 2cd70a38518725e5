#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "planner/base/check.h"
#include "planner/contingent/grounding/grounding.h"
#include "planner/contingent/pks_and_pddl/pks_file.h"
#include "planner/contingent/pks_and_pddl/task_file.h"
#include "planner/contingent/search/contingent_planner.h"
#include "planner/contingent/tree_check/tree_check.h"

namespace assay::contingent {
namespace {

GroundTask Grounded(const Task& task) {
  Externs externs;
  return Ground(task.domain, task.problem, externs);
}

// Reads, grounds and plans a task, and stores the results as counters.
ContingentPlan PlanTask(benchmark::State& state, const std::function<Task()>& read) {
  ContingentPlan plan;
  for (auto _ : state) {
    const GroundTask ground = Grounded(read());
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
  return plan;
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

// The figures of PO-PRP, the strongest contingent planner among those that could be compiled. They
// were measured on another machine of this kind: seconds from end to end, seconds of the search,
// and state-action pairs of the policy.
struct PublishedFigure {
  const char* problem;
  double seconds = 0;
  double search = 0;
  double pairs = 0;
};
constexpr PublishedFigure kPoPrp[] = {
    {"kvp-force-2", 0.35, 0.03, 11},  {"kvp-force-10", 0.38, 0.08, 51},
    {"kvp-visual-6", 0.35, 0.06, 43}, {"med-30", 0.49, 0.06, 90},
    {"med-99", 4.2, 0.7, 297},        {"doors5", 0.37, 0.06, 68},
    {"doors9", 1.8, 1.4, 277},        {"doors11", 34.5, 34, 461},
    {"ebtcs-70", 1.9, 0.3, 280},      {"wumpus05", 0.46, 0.12, 309},
    {"wumpus07", 1.8, 1.4, 1724},     {"wumpus10", 15.4, 14.7, 4400},
    {"unix4", 2.2, 0.3, 416}};

// The reasons why PO-PRP has no figure. A reason holds for all problems whose names begin with the
// text. Problems in neither list were not tried.
constexpr std::pair<const char*, const char*> kPoPrpHasNone[] = {
    {"doors13", "none in 120 s"}, {"localize", "refused"}, {"clog", "refused"},
    {"colorballs", "refused"},    {"medpks", "refused"},   {"RockSample", "refused"}};

void TellPoPrp(benchmark::State& state, std::string_view problem) {
  for (const PublishedFigure& figure : kPoPrp) {
    if (figure.problem != problem) continue;
    state.counters["po_prp_ms"] = 1000 * figure.seconds;
    state.counters["po_prp_search_ms"] = 1000 * figure.search;
    state.counters["po_prp_pairs"] = figure.pairs;
  }
  for (const auto& [beginning, why] : kPoPrpHasNone) {
    if (problem.starts_with(beginning)) state.SetLabel(why);
  }
}

// Wanted milliseconds.
constexpr std::pair<const char*, double> kWanted[] = {
    {"kvp-force-10", 10}, {"doors11", 1000}, {"wumpus10", 1000}};

// Times a problem. After the clock stops, a checker that shares no inference with the planner
// checks the tree.
void PlanProblem(benchmark::State& state, const std::filesystem::path& folder) {
  const auto read = [&] { return LoadTask(folder / "d.pddl", folder / "p.pddl"); };
  const ContingentPlan plan = PlanTask(state, read);
  const TreeCheck check = CheckTree(Grounded(read()), plan.tree);
  if (!check.holds) return state.SkipWithError(check.failure.c_str());
  state.counters["worlds"] = static_cast<double>(check.worlds);
  state.counters["all_worlds"] = check.AreAllWorlds();
  const std::string name = folder.filename().string();
  TellPoPrp(state, name);
  for (const auto& [problem, wanted] : kWanted) {
    if (problem == name) state.counters["at_most_ms"] = wanted;
  }
}

// Folders by the problem's name.
using ProblemFolders = std::map<std::string, std::filesystem::path>;

void FindProblems(const std::filesystem::path& folder, ProblemFolders& problems) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (!std::filesystem::exists(entry.path() / "d.pddl")) continue;
    problems.emplace(entry.path().filename().string(), entry.path());
  }
}

// Other people's benchmark problems are not in this repository. ASSAY_CONTINGENT names a folder
// that has a folder with d.pddl and p.pddl for each of them.
const bool kAdded = [] {
  ProblemFolders problems;
  FindProblems(ASSAY_SOURCE_DIR "/bench/workloads/contingent", problems);
  if (const char* const folder = std::getenv("ASSAY_CONTINGENT")) FindProblems(folder, problems);
  for (const auto& [name, folder] : problems) {
    benchmark::RegisterBenchmark(("Contingent/" + name).c_str(), [folder = folder](
                                                                     benchmark::State& state) {
      PlanProblem(state, folder);
    })->Unit(benchmark::kMillisecond);
  }
  return true;
}();

}  // namespace
}  // namespace assay::contingent
