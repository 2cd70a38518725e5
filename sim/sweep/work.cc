#include "sim/sweep/work.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>

#include "planner/plan/plan_file.h"
#include "sim/scenario/models_folder.h"
#include "sim/sense/overhead_camera.h"

namespace assay::sweep {
namespace {

namespace fs = std::filesystem;

std::string_view OutcomeName(Outcome outcome) {
  switch (outcome) {
    case Outcome::kFound:
      return "planned";
    case Outcome::kNone:
      return "none";
    case Outcome::kBudget:
      return "budget";
  }
  return "";
}

scenario::Scenario LoadScenario(const Sweep& sweep, const fs::path& models, const Cell& cell) {
  const fs::path file = sweep.PathOf(cell.scenario);
  scenario::Scenario scenario =
      scenario::Load(file, models.empty() ? scenario::FindModels(file) : models,
                     {.clearance = cell.clearance, .error_scale = cell.error_scale});
  scenario.simulation.scene.grasp = cell.grasp;
  return scenario;
}

CellRecord RecordOf(const Cell& cell, const domain::Problem& problem,
                    const plan::PlanResult& result) {
  const bool found = result.outcome == Outcome::kFound;
  return {.cell = cell.number,
          .scenario = cell.scenario,
          .clearance = problem.clearance,
          .error_scale = cell.error_scale,
          .propagation = std::string(Name(cell.propagation)),
          .noise = std::string(noise::Name(cell.noise)),
          .sensing = std::string(Name(cell.sensing)),
          .seed = static_cast<std::int64_t>(cell.seed),
          .trials = cell.trials,
          .grasp = std::string(Name(cell.grasp)),
          .outcome = std::string(OutcomeName(result.outcome)),
          .actions = static_cast<int>(result.plan.steps.size()),
          .errors = result.plan.errors,
          .proved = found && result.plan.errors == 0,
          .conflict = fmt::format("{}", fmt::join(result.conflict, "\n")),
          .plan = plan::ToJson(result, problem, cell.scenario).dump()};
}

std::shared_ptr<const Preparation> Prepare(scenario::Scenario scenario, plan::Plan plan,
                                           const check::HonestyGate* known_gate) {
  auto preparation = std::make_shared<Preparation>();
  preparation->box = noise::ErrorBox(scenario.problem, plan);
  preparation->gate = known_gate != nullptr
                          ? *known_gate
                          : check::MeasureGate(scenario.problem, plan, scenario.simulation.scene);
  preparation->scenario = std::move(scenario);
  preparation->plan = std::move(plan);
  return preparation;
}

PlannedCell PlanCell(const Sweep& sweep, const fs::path& models, const Cell& cell) {
  scenario::Scenario scenario = LoadScenario(sweep, models, cell);
  plan::PlanResult result =
      posting::MakeCertifiedPlan(scenario.problem, {.partial_plans = sweep.partial_plans},
                                 {.propagation = cell.propagation, .instances = sweep.instances});
  PlannedCell planned{cell, RecordOf(cell, scenario.problem, result), nullptr};
  if (result.outcome == Outcome::kFound) {
    planned.preparation = Prepare(std::move(scenario), std::move(result.plan), nullptr);
    planned.record.gate = planned.preparation->gate;
  }
  return planned;
}

PlannedCell RestoreCell(const Sweep& sweep, const fs::path& models, const Cell& cell,
                        const CellRecord& record) {
  PlannedCell planned{cell, record, nullptr};
  if (record.outcome != OutcomeName(Outcome::kFound)) return planned;
  scenario::Scenario scenario = LoadScenario(sweep, models, cell);
  plan::PlanResult result = plan::ReadPlan(
      Document::Parse(record.plan, fmt::format("plan of cell {}", cell.number)), scenario.problem);
  planned.preparation = Prepare(std::move(scenario), std::move(result.plan), &record.gate);
  return planned;
}

// Of the claims of a trial, in their order: "2/after/x of peg", with a number where a name comes
// again.
std::vector<std::string> ClaimNames(const plan::Plan& plan,
                                    const std::vector<check::Claim>& claims) {
  std::map<std::string, int> seen;
  std::vector<std::string> names;
  for (const check::Claim& claim : claims) {
    std::string name = fmt::format("{}/{}/{}", plan.step(claim.step).executed,
                                   check::Name(claim.about), claim.name);
    const int count = ++seen[name];
    names.push_back(count == 1 ? std::move(name) : fmt::format("{} #{}", name, count));
  }
  return names;
}

ClaimRecord RecordOf(const plan::PlannedStep& step, const check::Claim& claim, std::string name) {
  return {.claim = std::move(name),
          .step = step.executed,
          .action = step.name,
          .about = std::string(check::Name(claim.about)),
          .name = claim.name,
          .unit = claim.unit,
          .low = claim.predicted.low,
          .high = claim.predicted.high,
          .proved = claim.proved,
          .gate = claim.gate};
}

VerdictRecord RecordOf(const plan::PlannedStep& step, const check::CertificateVerdict& verdict) {
  const check::Claim& worst = verdict.worst;
  return {.step = step.executed,
          .action = step.name,
          .verdict = std::string(check::Name(verdict.verdict)),
          .claim = worst.name,
          .observed = worst.observed,
          .low = worst.predicted.low,
          .high = worst.predicted.high,
          .margin = worst.margin,
          .gate = worst.gate};
}

void Count(check::ClaimVerdict verdict, VerdictCounts& counts) {
  switch (verdict) {
    case check::ClaimVerdict::kContained:
      ++counts.contained;
      return;
    case check::ClaimVerdict::kInconclusive:
      ++counts.inconclusive;
      return;
    case check::ClaimVerdict::kViolated:
      ++counts.violated;
      return;
    case check::ClaimVerdict::kNotClaimed:
      ++counts.not_claimed;
      return;
  }
}

bool Senses(const plan::Plan& plan) {
  return std::ranges::any_of(plan.steps, [](const plan::PlannedStep& step) {
    return std::holds_alternative<plan::Sense>(step.action);
  });
}

TimedTrial RunTrial(const PlannedCell& cell, int number) {
  const auto start = std::chrono::steady_clock::now();
  TimedTrial timed = Recorded(cell.preparation->plan, Execute(cell, NoiseOf(cell, number), {}));
  timed.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return timed;
}

}  // namespace

noise::Noise NoiseOf(const PlannedCell& cell, int number) {
  return noise::Sample(cell.preparation->box, cell.cell.noise, cell.cell.seed, number);
}

check::NoisyTrial Execute(
    const PlannedCell& cell, const noise::Noise& noise,
    const std::function<void(const exec::StepEnd&, const mujoco::Data&)>& on_step_end) {
  const Preparation& preparation = *cell.preparation;
  const check::Experiment experiment{.problem = preparation.scenario.problem,
                                     .plan = preparation.plan,
                                     .scene = preparation.scenario.simulation.scene,
                                     .gate = preparation.gate};
  // The series of samples is of no use for verdicts.
  exec::ExecutorOptions options;
  options.sample_rate = 0;
  options.on_step_end = on_step_end;
  if (cell.cell.sensing == Sensing::kDrawn || !Senses(preparation.plan)) {
    return check::RunNoisyTrial(experiment, noise, options);
  }
  // A camera belongs to its thread, and sees the true world.
  const scene::Scene scene(experiment.problem, exec::TrueScene(experiment.scene, noise));
  sense::OverheadCamera camera(scene, experiment.problem);
  options.sensor = &camera;
  return check::RunNoisyTrial(experiment, noise, options);
}

TimedTrial Recorded(const plan::Plan& plan, const check::NoisyTrial& trial) {
  const exec::ExecutionEnd& end = trial.trace.end();
  const bool warned = end.outcome == exec::ExecutionOutcome::kEngineWarning;
  TimedTrial timed{.record = {.noise = noise::Text(trial.noise),
                              .outcome = std::string(check::Name(trial.verdict.outcome)),
                              .reason = trial.verdict.reason,
                              .simulated = end.moment.time,
                              .errors_signalled = trial.errors_signalled,
                              .recovered = trial.recovered,
                              .operator_called = trial.operator_called,
                              .warnings = warned ? end.reason : std::string()}};
  const std::vector<std::string> names = ClaimNames(plan, trial.claims);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const check::Claim& claim = trial.claims[i];
    timed.claims.push_back(RecordOf(plan.step(claim.step), claim, names[i]));
    timed.record.observations.push_back({names[i], claim.observed});
  }
  for (const check::CertificateVerdict& verdict : check::ByStep(trial.claims)) {
    timed.record.verdicts.push_back(RecordOf(plan.step(verdict.step), verdict));
    Count(verdict.verdict, timed.record.counts);
  }
  // As a database has them.
  std::ranges::sort(timed.record.observations, {}, &ObservationRecord::claim);
  std::ranges::sort(timed.record.verdicts, {}, &VerdictRecord::step);
  return timed;
}

Work RealWork(const Sweep& sweep, const fs::path& models) {
  return {.plan = [sweep, models](const Cell& cell) { return PlanCell(sweep, models, cell); },
          .restore =
              [sweep, models](const Cell& cell, const CellRecord& record) {
                return RestoreCell(sweep, models, cell, record);
              },
          .run = RunTrial};
}

}  // namespace assay::sweep
