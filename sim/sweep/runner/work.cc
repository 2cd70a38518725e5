#include "sim/sweep/runner/work.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "planner/assembly/certified_plan.h"
#include "planner/plan/plan_files/plan_file.h"
#include "sim/check/falsification/conservatism.h"
#include "sim/check/falsification/falsification.h"
#include "sim/sweep/database/recording.h"
#include "sim/sweep/runner/clock.h"

namespace assay::sweep {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPlanned = "planned";

scenario::Scenario LoadScenario(const Sweep& sweep, const domain::ModelPath& models,
                                const Cell& cell) {
  const fs::path file = sweep.PathOf(cell.scenario);
  scenario::Scenario scenario = scenario::Load(
      file, models,
      {.clearance = cell.clearance, .error_scale = cell.error_scale, .resolvers = cell.resolvers});
  return scenario;
}

// Returns the command that makes the plan of a cell again, or none if no options of `assay run`
// describe the cell.
std::optional<RunCommand> CommandOf(const Sweep& sweep, const domain::ModelPath& models,
                                    const Cell& cell, scene::GraspMode grasp_of_scenario) {
  const constraint_posting::PlannerOptions planner;
  const constraint_posting::UncertaintyOptions uncertainty;
  const bool usual =
      sweep.partial_plans == planner.partial_plans && sweep.instances == uncertainty.instances;
  if (cell.clearance || !usual) return std::nullopt;
  RunCommand command{.input = sweep.PathOf(cell.scenario),
                     .propagation = std::string(Name(cell.propagation)),
                     .error_scale = cell.error_scale,
                     .models = models};
  if (cell.resolvers) command.resolvers = {Name(*cell.resolvers)};
  if (cell.grasp != grasp_of_scenario) command.grasp = cell.grasp;
  return command;
}

CellRecord RecordOf(const Cell& cell, const domain::Problem& problem,
                    const plan::PlanResult& result) {
  const bool found = result.outcome == Outcome::kFound;
  const std::vector<std::string> reasons =
      result.limits.empty() ? TextsOf(result.conflict) : result.limits;
  return {.cell = cell.number,
          .scenario = cell.scenario,
          .clearance = problem.clearance,
          .error_scale = cell.error_scale,
          .propagation = std::string(Name(cell.propagation)),
          .resolvers = Name(problem.resolvers),
          .noise = std::string(Name(cell.noise)),
          .sensing = std::string(Name(cell.sensing)),
          .seed = static_cast<std::int64_t>(cell.seed),
          .trials = cell.trials,
          .grasp = std::string(Name(cell.grasp)),
          .outcome = std::string(Name(result.outcome, kPlanned)),
          .actions = static_cast<int>(result.plan.steps.size()),
          .errors = result.plan.errors,
          .proved = found && result.plan.errors == 0,
          .conflict = fmt::format("{}", fmt::join(reasons, "\n")),
          .plan = plan::ToJson(result, problem, cell.scenario).dump()};
}

check::Experiment ExperimentOf(const Preparation& preparation) {
  return {.problem = preparation.scenario.problem,
          .plan = preparation.plan,
          .scene = preparation.scenario.simulation.scene,
          .gate = preparation.gate};
}

// Makes the data that all trials of a cell share.
class Planning {
 public:
  Planning(const Sweep& sweep, const domain::ModelPath& models, const NoiseFloorOf& noise_floor)
      : sweep_(sweep), models_(models), noise_floor_(noise_floor) {}

  PlannedCell Plan(const Cell& cell) const {
    scenario::Scenario scenario = LoadScenario(sweep_, models_, cell);
    plan::PlanResult result = assembly::MakeCertifiedPlan(
        scenario.problem, {.partial_plans = sweep_.partial_plans},
        {.propagation = cell.propagation, .instances = sweep_.instances});
    PlannedCell planned{cell, RecordOf(cell, scenario.problem, result), nullptr};
    if (result.outcome == Outcome::kFound) {
      planned.preparation =
          Prepare(cell, std::move(scenario), std::move(result.plan), noise_floor_);
      planned.record.gate = planned.preparation->gate;
      ExecuteWithoutNoise(*planned.preparation, planned.record);
    }
    return planned;
  }

  PlannedCell Restore(const Cell& cell, const CellRecord& record) const {
    PlannedCell planned{cell, record, nullptr};
    if (record.outcome != kPlanned) return planned;
    scenario::Scenario scenario = LoadScenario(sweep_, models_, cell);
    plan::PlanResult result =
        plan::ReadPlan(Document::Parse(record.plan, fmt::format("plan of cell {}", cell.number)),
                       scenario.problem);
    const auto recorded = [&](const auto&...) { return record.gate; };
    planned.preparation = Prepare(cell, std::move(scenario), std::move(result.plan), recorded);
    return planned;
  }

 private:
  // A plan that does not hold without noise cannot be tested by trials with noise.
  static void ExecuteWithoutNoise(const Preparation& preparation, CellRecord& record) {
    const check::Noiseless noiseless = check::ExecuteWithoutNoise(ExperimentOf(preparation));
    if (noiseless.Holds()) return;
    record.outcome = "untestable";
    record.conflict = WrongWithoutNoise(preparation.plan, noiseless, preparation.gate);
  }

  std::shared_ptr<const Preparation> Prepare(const Cell& cell, scenario::Scenario scenario,
                                             plan::Plan plan,
                                             const NoiseFloorOf& noise_floor) const {
    auto preparation = std::make_shared<Preparation>();
    scene::SceneOptions& scene = scenario.simulation.scene;
    preparation->run_command = CommandOf(sweep_, models_, cell, scene.grasp);
    scene.grasp = cell.grasp;
    preparation->box = noise::ErrorBox(scenario.problem, plan);
    preparation->gate = noise_floor(scenario.problem, plan, scene);
    preparation->scenario = std::move(scenario);
    preparation->plan = std::move(plan);
    return preparation;
  }

  const Sweep& sweep_;
  const domain::ModelPath& models_;
  const NoiseFloorOf& noise_floor_;
};

bool Senses(const plan::Plan& plan) {
  return std::ranges::any_of(
      plan.steps, [](const plan::PlannedStep& step) { return step.action.Is(domain::kSense); });
}

TimedTrial RunTrial(const PlannedCell& cell, int number) {
  const Clock::time_point start = Clock::now();
  TimedTrial timed =
      Recorded(cell.preparation->plan, Execute(cell, NoiseOf(cell, number), nullptr));
  timed.seconds = SecondsSince(start);
  return timed;
}

TimedTrial RunFalsification(const Sweep& sweep, const PlannedCell& cell,
                            const FalsificationControl& control) {
  const Clock::time_point start = Clock::now();
  const check::Experiment experiment = ExperimentOf(*cell.preparation);
  check::FalsificationOptions options = {
      .attempts = sweep.attempts, .seed = cell.cell.seed, .jobs = control.jobs};
  options.progress = control.progress;
  const check::FalsificationResult result = check::Falsify(experiment, options);
  std::vector<check::ConservatismRatio> ratios;
  if (sweep.conservatism) {
    // The progress callback is called before each trial, too, so that it can break off by throwing.
    const auto tell = [&] {
      if (control.progress) control.progress(result.attempts);
    };
    const auto is_broken_off = [&] {
      try {
        tell();
        return false;
      } catch (...) {
        return true;
      }
    };
    ratios = check::Conservatism(
        experiment, {.seed = cell.cell.seed, .jobs = control.jobs, .stop = is_broken_off});
    tell();  // throws again if it has broken off the comparison
  }
  TimedTrial timed = Recorded(cell.preparation->plan,
                              MadeFalsification{.result = result,
                                                .ratios = ratios,
                                                .run_command = cell.preparation->run_command,
                                                .replay_command = fmt::format(
                                                    "assay replay DB {}", cell.cell.first_trial)});
  timed.seconds = SecondsSince(start);
  return timed;
}

}  // namespace

noise::Noise NoiseOf(const PlannedCell& cell, int number) {
  const Preparation& preparation = *cell.preparation;
  return noise::Sample(preparation.scenario.problem, preparation.box, ModeOf(cell.cell.noise),
                       cell.cell.seed, number);
}

check::Trial Execute(const PlannedCell& cell, const noise::Noise& noise,
                     execution::Observer* observer, double sample_rate) {
  const Preparation& preparation = *cell.preparation;
  const check::Experiment experiment = ExperimentOf(preparation);
  execution::ExecutorOptions options;
  options.sample_rate = sample_rate;
  options.observer = observer;
  const bool looks = cell.cell.sensing == Sensing::kCamera && Senses(preparation.plan);
  return check::RunTrial(experiment, noise, options, looks ? Sensing::kCamera : Sensing::kDrawn);
}

Work RealWork(const Sweep& sweep, const domain::ModelPath& models,
              const NoiseFloorOf& noise_floor) {
  return {.plan = [=](const Cell& cell) { return Planning(sweep, models, noise_floor).Plan(cell); },
          .restore =
              [=](const Cell& cell, const CellRecord& record) {
                return Planning(sweep, models, noise_floor).Restore(cell, record);
              },
          .run = RunTrial,
          .falsification =
              [sweep](const PlannedCell& cell, const FalsificationControl& control) {
                return RunFalsification(sweep, cell, control);
              }};
}

}  // namespace assay::sweep
