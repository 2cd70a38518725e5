#include "sim/python/trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "planner/base/input_files/quotation.h"
#include "planner/base/stop.h"
#include "sim/check/noise_floor/noiseless.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/plan_output/plan_text.h"
#include "sim/cli/shown_executions/trial_execution.h"
#include "sim/cli/tasks/noise_floor_cache.h"
#include "sim/execution/trial/scheduler.h"
#include "sim/noise/possible_start.h"
#include "sim/noise/sampling.h"
#include "sim/python/refused.h"
#include "sim/sweep/database/recording.h"

namespace assay::python {
namespace {

using Json = nlohmann::ordered_json;

int IndexAmong(const char* what, const std::string& name, const std::vector<std::string>& names) {
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<int>(found - names.begin());
  throw cli::UsageError(
      fmt::format("there is no {} {}; allowed: {}", what, Quote(name), fmt::join(names, ", ")));
}

// Wrong settings are refused before the work that takes time.
void RequireTrialSettings(const TrialSettings& settings, const std::vector<noise::Channel>& box) {
  if (settings.noise) IndexAmong("noise", *settings.noise, noise::ModeNames());
  IndexAmong("sensing", settings.sensing, {"drawn", "camera"});
  if (settings.noise && settings.errors) {
    throw cli::UsageError("noise and errors exclude each other");
  }
  if (settings.errors) noise::ParseNoise(*settings.errors, box);
}

// Returns the plan's error box, for which the settings must be right.
std::vector<noise::Channel> BoxOf(const PlanHandle& plan, const TrialSettings& settings) {
  std::vector<noise::Channel> box = noise::ErrorBox(plan.planned().problem, plan.plan());
  RequireTrialSettings(settings, box);
  return box;
}

scene::SceneOptions SceneOptionsOf(const PlanHandle& plan, const TrialSettings& settings) {
  scene::SceneOptions options = plan.planned().simulation.scene;
  if (settings.grasp) {
    options.grasp =
        static_cast<scene::GraspMode>(IndexAmong("grasp", *settings.grasp, sweep::GraspNames()));
  }
  return options;
}

check::Experiment ExperimentOf(const PlanHandle& plan, const scene::SceneOptions& scene,
                               bool has_noise) {
  const plan::CheckReport& report = plan.Checked();
  if (!report.flaws.empty()) {
    throw Refused{cli::ExitCode::kFailed, cli::Text(plan.plan(), report)};
  }
  check::Experiment experiment{plan.planned().problem, plan.plan(), scene};
  if (has_noise) {
    experiment.gate = cli::KeptNoiseFloor(experiment.problem, experiment.plan, scene);
  }
  return experiment;
}

bool StopIsRequested() { return stop_requested; }

}  // namespace

Trials::Trials(std::shared_ptr<const PlanHandle> plan, const TrialSettings& settings,
               bool is_falsification)
    : plan_(std::move(plan)),
      settings_(settings),
      seed_(settings.seed.value_or(plan_->planned().simulation.seed)),
      box_(BoxOf(*plan_, settings)),
      scene_options_(SceneOptionsOf(*plan_, settings)),
      experiment_(ExperimentOf(*plan_, scene_options_, is_falsification || HasNoise())),
      scene_(HasNoise() || is_falsification
                 ? std::nullopt
                 : std::optional<scene::Scene>(std::in_place, plan_->planned().problem,
                                               scene_options_)) {
  if (!settings.errors) return;  // wrong errors are refused early
  noise::PossibleStart(plan_->planned().problem).Require(noise::ParseNoise(*settings.errors, box_));
}

std::string Trials::WrongWithoutNoise() const {
  if (!settings_.noise) return "";
  const check::Noiseless noiseless = check::ExecuteWithoutNoise(experiment_);
  return sweep::WrongWithoutNoise(plan_->plan(), noiseless, experiment_.gate);
}

check::Trial Trials::One(int number, bool with_samples) const {
  execution::ExecutorOptions options;
  if (!with_samples) options.sample_rate = 0;
  check::Trial trial =
      scene_ ? check::RunTrial(experiment_.problem, experiment_.plan, *scene_, options)
             : check::RunTrial(experiment_, NoiseOf(number), options,
                               settings_.sensing == "camera" ? check::Sensing::kCamera
                                                             : check::Sensing::kDrawn);
  trial.number = number;
  return trial;
}

noise::Noise Trials::NoiseOf(int number) const {
  if (settings_.errors) return noise::ParseNoise(*settings_.errors, box_);
  const int mode = IndexAmong("noise", *settings_.noise, noise::ModeNames());
  return noise::Sample(plan_->planned().problem, box_, static_cast<noise::Mode>(mode), seed_,
                       number);
}

std::vector<sweep::TimedTrial> Trials::Run(int count, int jobs) const {
  std::vector<sweep::TimedTrial> trials;
  execution::Scheduler scheduler(jobs, StopIsRequested);
  scheduler.InOrder(
      static_cast<std::size_t>(count),
      [this](std::size_t i) {
        const int number = static_cast<int>(i) + 1;
        sweep::TimedTrial timed = sweep::Recorded(plan_->plan(), One(number, false));
        timed.record.number = number;
        return timed;
      },
      [&](std::size_t, sweep::TimedTrial timed) { trials.push_back(std::move(timed)); });
  return trials;
}

std::shared_ptr<const TracedTrial> Trials::Traced(int number) const {
  const std::string& file = plan_->planned().file();
  check::Trial trial = One(number, true);
  return std::make_shared<const TracedTrial>(
      HasNoise() ? cli::TrialExecution(experiment_, std::move(trial),
                                       fmt::format("trial {} of {}", number, file), file)
                 : cli::NoiselessExecution(experiment_, std::move(trial),
                                           fmt::format("{}, executed without noise", file), file));
}

MadeFalsification Trials::Falsify(std::int64_t attempts, int jobs) const {
  const check::FalsificationResult result = check::Falsify(
      experiment_, {.attempts = attempts, .seed = seed_, .jobs = jobs, .stop = StopIsRequested});
  return {
      .record =
          sweep::Recorded(plan_->plan(), sweep::MadeFalsification{.result = result,
                                                                  .ratios = {},
                                                                  .run_command = plan_->command(),
                                                                  .replay_command = ""}),
      .untestable = sweep::WrongWithoutNoise(plan_->plan(), result.noiseless, experiment_.gate)};
}

Json ErrorBoxOf(const PlanHandle& plan) {
  Json rows = Json::array();
  for (const noise::Channel& channel : noise::ErrorBox(plan.planned().problem, plan.plan())) {
    rows.push_back({{"variable", channel.name},
                    {"unit", domain::SiUnitOf(noise::DimensionOf(channel.effect)).name},
                    {"low", channel.range.low},
                    {"high", channel.range.high}});
  }
  return rows;
}

Json ToJson(const sweep::TimedTrial& timed) {
  const sweep::TrialRecord& r = timed.record;
  std::map<std::string, double> observed;
  for (const sweep::ObservationRecord& o : r.observations) observed[o.claim] = o.observed;
  Json claims = Json::array();
  for (const sweep::ClaimRecord& c : timed.claims) {
    const auto found = observed.find(c.claim);
    claims.push_back({{"claim", c.claim},
                      {"step", c.step},
                      {"action", c.action},
                      {"about", c.about},
                      {"name", c.name},
                      {"unit", domain::SiUnitOf(c.dimension).name},
                      {"low", c.low},
                      {"high", c.high},
                      {"gate", c.gate},
                      {"proved", c.proved},
                      {"observed", found == observed.end() ? Json() : Json(found->second)}});
  }
  Json verdicts = Json::array();
  for (const sweep::VerdictRecord& v : r.verdicts) {
    verdicts.push_back({{"step", v.step},
                        {"action", v.action},
                        {"verdict", v.verdict},
                        {"claim", v.claim},
                        {"observed", v.observed},
                        {"low", v.low},
                        {"high", v.high},
                        {"margin", v.margin},
                        {"gate", v.gate}});
  }
  return {{"trial",
           {{"trial", r.number},
            {"outcome", r.outcome},
            {"reason", r.reason},
            {"violated", r.counts.violated},
            {"inconclusive", r.counts.inconclusive},
            {"contained", r.counts.contained},
            {"errors_signalled", r.errors_signalled},
            {"recovered", r.recovered},
            {"operator_called", r.operator_called},
            {"simulated", r.simulated},
            {"steps", r.steps},
            {"warnings", r.warnings},
            {"noise", r.noise}}},
          {"verdicts", verdicts},
          {"claims", claims}};
}

Json ToJson(const sweep::FalsificationRecord& falsification) {
  Json worst = Json::array();
  for (const sweep::WorstClaimRecord& w : falsification.worst) {
    worst.push_back({{"claim", w.claim},
                     {"step", w.step},
                     {"action", w.action},
                     {"about", w.about},
                     {"name", w.name},
                     {"unit", domain::SiUnitOf(w.dimension).name},
                     {"verdict", w.verdict},
                     {"observed", w.observed},
                     {"low", w.low},
                     {"high", w.high},
                     {"margin", w.margin},
                     {"gate", w.gate},
                     {"phase", w.phase},
                     {"attempt", w.attempt},
                     {"noise", w.noise}});
  }
  Json examples = Json::array();
  for (const sweep::CounterexampleRecord& e : falsification.counterexamples) {
    examples.push_back({{"number", e.number},
                        {"claim", e.claim},
                        {"action", e.action},
                        {"unit", domain::SiUnitOf(e.dimension).name},
                        {"observed", e.observed},
                        {"low", e.low},
                        {"high", e.high},
                        {"margin", e.margin},
                        {"gate", e.gate},
                        {"steps", e.steps},
                        {"multiple", e.multiple},
                        {"replayed", e.replayed},
                        {"noise", e.noise},
                        {"replay", e.replay}});
  }
  return {{"attempts", falsification.attempts},
          {"contained", falsification.certificates.contained},
          {"inconclusive", falsification.certificates.inconclusive},
          {"violated", falsification.certificates.violated},
          {"not_claimed", falsification.certificates.not_claimed},
          {"worst", worst},
          {"counterexamples", examples}};
}

}  // namespace assay::python
