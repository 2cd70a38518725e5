#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <limits>

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
BENCHMARK(ForceSensing)->RangeMultiplier(2)->Range(2, 64)->Arg(10)->Unit(benchmark::kMillisecond);

// The benchmark problems of others are not here: ASSAY_CONTINGENT names a folder with a folder for
// each of them, of d.pddl and p.pddl.
const int kRegistered = [] {
  const char* const folder = std::getenv("ASSAY_CONTINGENT");
  if (folder == nullptr) return 0;
  int registered = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::filesystem::path domain = entry.path() / "d.pddl";
    if (!std::filesystem::exists(domain)) continue;
    benchmark::RegisterBenchmark(entry.path().filename().c_str(), [domain](
                                                                      benchmark::State& state) {
      PlanTask(state, [&] { return LoadTask(domain, domain.parent_path() / "p.pddl"); });
    })->Unit(benchmark::kMillisecond);
    ++registered;
  }
  return registered;
}();

}  // namespace
}  // namespace assay::contingent
