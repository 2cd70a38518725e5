#include <benchmark/benchmark.h>

#include <string>

#include "planner/posting/posting_planner.h"
#include "sim/exec/executor.h"
#include "sim/scenario/scenario.h"

namespace assay {
namespace {

scenario::Scenario Load(const std::string& name) {
  return scenario::Load(std::string(ASSAY_SOURCE_DIR) + "/scenarios/" + name + ".yaml");
}

// A whole trial, without pictures. real_time_factor: seconds simulated in a second.
void Execute(benchmark::State& state, const std::string& name) {
  const scenario::Scenario scenario = Load(name);
  const plan::PlanResult result = posting::MakePlan(scenario.problem, {});
  const scene::Scene scene(scenario.problem, scenario.simulation.scene);
  double simulated = 0;
  for (auto _ : state) {
    mujoco::Data data = scene.Start();
    simulated += exec::Execute(scenario.problem, result.plan, scene, data, {}).end().moment.time;
  }
  state.counters["real_time_factor"] = benchmark::Counter(simulated, benchmark::Counter::kIsRate);
}

// Steps of the engine with the parts at rest and the arm held by its servos: what executing adds
// to them is the difference to `Execute`.
void Step(benchmark::State& state, const std::string& name) {
  const scenario::Scenario scenario = Load(name);
  const scene::Scene scene(scenario.problem, scenario.simulation.scene);
  mujoco::Data data = scene.Start();
  for (auto _ : state) data.Step();
  state.counters["real_time_factor"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * data.timestep(),
                         benchmark::Counter::kIsRate);
}

BENCHMARK_CAPTURE(Execute, fig13, "spar-fig13")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Execute, fig15, "spar-fig15")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Execute, two_pegs, "two-pegs")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Step, fig13, "spar-fig13")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace assay
