#include <benchmark/benchmark.h>

#include <string>

#include "planner/assembly/certified_plan.h"
#include "sim/check/noise_floor/measure_noise_floor.h"
#include "sim/check/trial_verdicts/trial.h"
#include "sim/noise/error_box.h"
#include "sim/noise/sampling.h"
#include "sim/scenario/scenario.h"

namespace assay {
namespace {

constexpr std::uint64_t kSeed = 1;

// Times a trial as in `assay run --noise uniform`, after there is a plan. The noise floor is left
// out, since all trials share it. Errors are drawn, the scene is compiled, its parts settle, the
// plan is executed, and every claim of its certificates is compared with the simulation.
void WholeTrial(benchmark::State& state, const std::string& name) {
  const scenario::Scenario scenario =
      scenario::Load(std::string(ASSAY_SOURCE_DIR) + "/scenarios/" + name + ".yaml");
  const plan::Plan plan = assembly::MakeCertifiedPlan(scenario.problem, {}, {}).plan;
  const auto box = noise::ErrorBox(scenario.problem, plan);
  const scene::SceneOptions& scene = scenario.simulation.scene;
  const check::Experiment experiment = {
      .problem = scenario.problem,
      .plan = plan,
      .scene = scene,
      .gate = check::MeasureNoiseFloor(scenario.problem, plan, scene)};
  check::Trial trial;
  double simulated = 0;
  for (auto _ : state) {
    const noise::Noise noise =
        noise::Sample(scenario.problem, box, noise::Mode::kUniform, kSeed, 1);
    trial = check::RunTrial(experiment, noise, {.sample_rate = 0});
    simulated += trial.trace.end().snapshot.time;
  }
  if (trial.verdict.outcome != check::TrialOutcome::kSucceeded) {
    return state.SkipWithError(trial.verdict.reason.c_str());
  }
  state.counters["steps"] = static_cast<double>(trial.trace.end().steps);
  state.counters["claims"] = static_cast<double>(trial.claims.size());
  state.counters["real_time_factor"] = benchmark::Counter(simulated, benchmark::Counter::kIsRate);
}

BENCHMARK_CAPTURE(WholeTrial, fig13, "spar-fig13")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(WholeTrial, fig15, "spar-fig15")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace assay
