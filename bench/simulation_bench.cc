#include <benchmark/benchmark.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "bench/harness/contest.h"
#include "planner/constraint_posting/posting_planner.h"
#include "sim/execution/walk/executor.h"
#include "sim/mujoco/collision/convex_pieces.h"
#include "sim/scenario/scenario.h"

namespace assay {
namespace {

constexpr int kWindow = 100;         // number of steps that are replayed from a saved state
constexpr double kSameState = 1e-3;  // greatest difference after a window, metres and radians

// A scenario with its plan, and the commands to the engine during one execution.
struct Run {
  // The commands of one step.
  struct Told {
    double timestep;
    std::vector<double> ctrl;
    std::vector<double> qfrc_applied;
  };
  struct Window {
    mujoco::State start;
    std::vector<Told> steps = {};
    std::vector<double> qpos = {};  // joint values at the window's end
  };

  scenario::Scenario scenario;
  plan::Plan plan;
  scene::Scene scene;
  std::vector<Window> windows = {};
  std::int64_t steps = 0;

  explicit Run(const std::string& name)
      : scenario(scenario::Load(std::string(ASSAY_SOURCE_DIR) + "/scenarios/" + name + ".yaml")),
        plan(constraint_posting::MakePlan(scenario.problem, {}).plan),
        scene(scenario.problem, scenario.simulation.scene) {}

  execution::Trace Execute(const execution::ExecutorOptions& options) const {
    mujoco::Data data = scene.Start();
    return execution::Execute(scenario.problem, plan, scene, data, options);
  }

  void Record() {
    Execute({.kinematic_step = 0, .on_timestep = [this](const mujoco::Data& data) { Note(data); }});
    // The end of the execution cut it short.
    if (windows.back().steps.size() < kWindow) windows.pop_back();
  }

 private:
  // Notes a step. States are saved between windows, and the commands of the saving step belong to
  // the earlier window.
  void Note(const mujoco::Data& data) {
    ++steps;
    if (!windows.empty()) {
      Window& window = windows.back();
      const auto copied = [](std::span<const double> numbers) {
        return std::vector<double>(numbers.begin(), numbers.end());
      };
      const mjData* engine = data.get();
      window.steps.push_back({data.timestep(),
                              copied(data.ctrl()),
                              {engine->qfrc_applied, engine->qfrc_applied + data.own_model()->nv}});
      if (window.steps.size() < kWindow) return;
      window.qpos = copied(data.qpos());
    }
    windows.push_back({.start = data.Save()});
  }
};

const Run& Recorded(const std::string& name) {
  static std::map<std::string, Run> runs;
  const auto [at, is_new] = runs.try_emplace(name, name);
  if (is_new) at->second.Record();
  return at->second;
}

// Times the plan's execution with everything that it does besides stepping.
void Execute(benchmark::State& state, const std::string& name) {
  const Run& run = Recorded(name);
  double simulated = 0;
  for (auto _ : state) simulated += run.Execute({}).end().snapshot.time;
  state.counters["steps"] = static_cast<double>(run.steps);
  state.counters["real_time_factor"] = benchmark::Counter(simulated, benchmark::Counter::kIsRate);
}

void Replay(const Run::Window& window, mujoco::Data& data) {
  data.Restore(window.start);
  const mujoco::CollidingPieces colliding(data.model().convex_pieces());
  mjModel* model = const_cast<mjModel*>(data.own_model());
  for (const Run::Told& told : window.steps) {
    model->opt.timestep = told.timestep;
    std::ranges::copy(told.ctrl, data.get()->ctrl);
    std::ranges::copy(told.qfrc_applied, data.get()->qfrc_applied);
    mj_step(model, data.get());
  }
}

bool EndsWhereWeDid(const Run::Window& window, const mujoco::Data& data) {
  return std::ranges::equal(window.qpos, data.qpos(),
                            [](double a, double b) { return std::abs(a - b) < kSameState; });
}

// Times the engine's loop alone, with the commands of the execution.
void BareLoop(benchmark::State& state, const std::string& name) {
  const Run& run = Recorded(name);
  mujoco::Data data = run.scene.Start();
  std::size_t alike = 0;
  for (const Run::Window& window : run.windows) {
    Replay(window, data);
    alike += EndsWhereWeDid(window, data);
  }
  if (alike < run.windows.size() * 99 / 100) return state.SkipWithError("it goes elsewhere");
  for (auto _ : state) {
    for (const Run::Window& window : run.windows) Replay(window, data);
  }
  state.counters["steps"] = static_cast<double>(run.windows.size() * kWindow);
}

const bool kAdded = [] {
  bench::Announce(
      "simulation",
      {.measured = "the execution of a plan from the first step to the last. The peer is a loop of "
                   "the engine's mj_step with the same controls, which continues from a saved "
                   "state of the execution every 100 steps",
       .unfair =
           "assay moves robots without dynamics while no force decides anything, and the bare "
           "loop steps through all motion. assay also controls the arm, watches forces and records "
           "the trace. The bare loop "
           "copies a saved state every 100 steps and the controls at each step. Both use the check "
           "of box collisions of assay, which removes duplicate contacts before the solver runs",
       .never_below = 0.95});
  const std::vector<std::string> scenarios =
      bench::Tiny() ? std::vector<std::string>{"spar-fig15"}
                    : std::vector<std::string>{"spar-fig13", "spar-fig15", "two-pegs"};
  for (const std::string& name : scenarios) {
    bench::AddContestant("simulation", name, "assay",
                         [name](benchmark::State& state) { Execute(state, name); });
    bench::AddContestant("simulation", name, "mujoco",
                         [name](benchmark::State& state) { BareLoop(state, name); });
  }
  return true;
}();

}  // namespace
}  // namespace assay
