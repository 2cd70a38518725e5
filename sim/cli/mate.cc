#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>
#include <optional>

#include "sim/check/margin_ranking.h"
#include "sim/cli/console.h"
#include "sim/cli/mating_pictures.h"
#include "sim/cli/mating_report.h"
#include "sim/cli/mating_trials.h"
#include "sim/cli/output_file.h"
#include "sim/cli/planned_problem.h"
#include "sim/cli/progress.h"
#include "sim/cli/stopwatch.h"
#include "sim/cli/trial.h"
#include "sim/cli/usage_error.h"
#include "sim/cli/verb.h"

namespace assay::cli {
namespace {

using Json = nlohmann::ordered_json;
using finemotion::FineMotionPlan;
using finemotion::MatingGeometry;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kMillimetre = 1e-3;

struct Options {
  std::filesystem::path scenario;
  std::filesystem::path models;
  double displacement_mm = 2;
  double rotation_deg = 1;
  std::optional<double> clearance_mm;
  std::optional<double> friction;
  double beyond = 1;
  int trials = 0;
  std::optional<int> trial;  // the only one
  int jobs = 1;
  std::uint64_t seed = 1;
  std::uint64_t search_seed = 1;
  finemotion::MeetingTest intersection = finemotion::MeetingTest::kExact;
  scene::GraspMode grasp = scene::GraspMode::kWeld;
  std::filesystem::path pictures;  // folder
  bool json = false;
};

const std::map<std::string, finemotion::MeetingTest>& Intersections() {
  using finemotion::MeetingTest;
  static const std::map<std::string, MeetingTest> names = {{"exact", MeetingTest::kExact},
                                                           {"edges", MeetingTest::kEdges},
                                                           {"compare", MeetingTest::kCompare}};
  return names;
}

PlannedProblem Planned(const Options& options) {
  scenario::Overrides overrides;
  if (options.clearance_mm) overrides.clearance = *options.clearance_mm * kMillimetre;
  return MakePlan(options.scenario, options.models, {}, {}, overrides);
}

// The last assemble action of a plan: what fine motion is for.
const plan::Assemble& AssembleOf(const PlannedProblem& planned) {
  const plan::Assemble* found = nullptr;
  for (const plan::StepId id : planned.result.plan.ExecutionOrder()) {
    const auto* assemble = std::get_if<plan::Assemble>(&planned.result.plan.step(id).action);
    if (assemble != nullptr) found = assemble;
  }
  if (found != nullptr) return *found;
  throw UsageError(fmt::format("mate: {}: no plan with an assemble action", planned.scenario));
}

finemotion::FineMotionErrors ErrorsOf(const Options& options, const MatingGeometry& geometry) {
  finemotion::FineMotionErrors errors;
  errors.tolerances = geometry.tolerances;
  errors.pose.head<3>().setConstant(options.displacement_mm * kMillimetre);
  errors.pose.tail<3>().setConstant(options.rotation_deg * kDegree);
  return errors;
}

finemotion::StrategyOptions SearchOptions(const Options& options, const domain::Problem& problem) {
  const double usual = problem.workcell->rules().friction + problem.tolerances.friction;
  return {.friction = options.friction.value_or(usual),
          .test = options.intersection,
          .seed = options.search_seed};
}

// What makes the trials again, up to the number of one.
std::string ReplayCommand(const Options& options) {
  const Options usual;
  std::string command = fmt::format("assay mate {}", options.scenario.string());
  const auto add = [&](const char* name, const auto& value, const auto& default_value) {
    if (value != default_value) command += fmt::format(" --{} {}", name, value);
  };
  add("displacement", options.displacement_mm, usual.displacement_mm);
  add("rotation", options.rotation_deg, usual.rotation_deg);
  if (options.clearance_mm) command += fmt::format(" --clearance {}", *options.clearance_mm);
  if (options.friction) command += fmt::format(" --friction {}", *options.friction);
  add("beyond", options.beyond, usual.beyond);
  for (const auto& [name, test] : Intersections()) {
    if (test == options.intersection) add("intersection", name, "exact");
  }
  add("seed", options.seed, usual.seed);
  add("search-seed", options.search_seed, usual.search_seed);
  add("grasp", scene::Name(options.grasp), scene::Name(usual.grasp));
  if (!options.models.empty()) command += fmt::format(" --models {}", options.models.string());
  return command + " --trial ";
}

std::vector<int> NumbersOf(const Options& options) {
  if (options.trial) return {*options.trial};
  std::vector<int> numbers(static_cast<std::size_t>(options.trials));
  std::iota(numbers.begin(), numbers.end(), 1);
  return numbers;
}

MatingStudy Tried(const PlannedProblem& planned, const MatingGeometry& geometry,
                  const FineMotionPlan& plan, const Options& options) {
  Progress progress("mating in physics");
  MatingTrialSettings settings{.errors = ErrorsOf(options, geometry),
                               .beyond = options.beyond,
                               .scene = planned.simulation.scene,
                               .seed = options.seed};
  settings.scene.grasp = options.grasp;
  if (options.friction) settings.scene.part_friction = *options.friction;
  const MatingTrials trials(planned, AssembleOf(planned), geometry, settings);
  const plan::Strategy strategy =
      finemotion::StrategyOf(geometry, plan, SearchOptions(options, planned.problem));
  const check::PlannedContacts contacts = check::PlannedContactsOf(plan);
  const std::vector<int> numbers = NumbersOf(options);
  MatingStudy study{.strategy = std::vector<MatedTrial>(numbers.size()),
                    .straight = std::vector<MatedTrial>(numbers.size()),
                    .covered = plan.absorbed,
                    .replay = ReplayCommand(options)};
  ForEachTrial(static_cast<int>(numbers.size()), options.jobs, [&](int nth) {
    const auto i = static_cast<std::size_t>(nth - 1);
    study.strategy[i] = trials.RunStrategy(numbers[i], strategy, contacts);
    study.straight[i] = trials.RunStraight(numbers[i]);
    progress.Tell(fmt::format("mating in physics, trial {} of {}", nth, numbers.size()));
  });
  std::vector<check::SequenceComparison> comparisons;
  for (const MatedTrial& trial : study.strategy) comparisons.push_back(trial.sequence->comparison);
  study.ranking = check::RankMargins(geometry.passage, plan,
                                     SearchOptions(options, planned.problem).reach, comparisons);
  return study;
}

ExitCode Execute(const Options& options) {
  if (!options.pictures.empty()) MakeFolder(options.pictures);
  const PlannedProblem planned = Planned(options);
  const MatingGeometry geometry =
      finemotion::GeometryOf(planned.problem, planned.problem.mating(AssembleOf(planned).mating));
  Json seconds;
  const Stopwatch graphing;
  const finemotion::LocalTopology topology = TopologyOf(geometry.passage);
  seconds["graph"] = graphing.Seconds();
  const Stopwatch searching;
  const FineMotionPlan plan = finemotion::SearchStrategy(
      geometry.passage, ErrorsOf(options, geometry), SearchOptions(options, planned.problem));
  seconds["search"] = searching.Seconds();
  Json json = ToJson(geometry, plan, topology.graph);
  std::string text = TextOf(geometry, plan);
  ExitCode code = plan.found ? ExitCode::kDone : ExitCode::kNoPlan;
  if ((options.trials > 0 || options.trial) && !plan.motions.empty()) {
    const Stopwatch trying;
    const MatingStudy study = Tried(planned, geometry, plan, options);
    seconds["trials"] = trying.Seconds();
    text += TextOf(study);
    json["trials"] = ToJson(study);
    if (plan.found && study.CoveredFailures() > 0) code = ExitCode::kFailed;
  }
  if (!options.pictures.empty() && !plan.motions.empty()) {
    const std::vector<std::string> files = WriteMatingPictures(
        options.pictures,
        {planned, planned.problem.mating(AssembleOf(planned).mating), geometry, topology, plan,
         StrategyOf(geometry, plan, SearchOptions(options, planned.problem))});
    json["pictures"] = files;
    text += fmt::format("{}\n", fmt::join(files, "\n"));
  }
  json["seconds"] = seconds;
  Print(options.json ? json.dump(2) + "\n" : text);
  return code;
}

void AddUncertainty(CLI::App& command, Options& options) {
  command
      .add_option("--displacement", options.displacement_mm,
                  "of the part in the hand at first: so many mm at most, in x, y and z")
      ->check(CLI::Range(0.0, 20.0))
      ->capture_default_str();
  command
      .add_option("--rotation", options.rotation_deg, "so many degrees at most, about x, y and z")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command
      .add_option("--clearance", options.clearance_mm, "mm on each side, instead of the scenario's")
      ->check(CLI::Range(0.0, 100.0));
  command.add_option("--friction", options.friction, "of the parts, instead of the part files'")
      ->check(CLI::Range(0.0, 10.0));
  command
      .add_option(
          "--intersection", options.intersection,
          "how it is decided whether errors can make a contact: exact (the default), edges "
          "(as Dakin and Popplestone have it, which misses some), or compare (exact, and how "
          "often edges differs)")
      ->transform(CLI::CheckedTransformer(Intersections()));
  command.add_option("--search-seed", options.search_seed, "of all that is random in planning")
      ->capture_default_str();
}

void AddTrials(CLI::App& command, Options& options) {
  command
      .add_option("--trials", options.trials, "execute it so often, and a straight line beside it")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()));
  command.add_option("--trial", options.trial, "run only this one of the trials")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  command
      .add_option("--beyond", options.beyond,
                  "trials draw errors from a box so many times as wide as planned for")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  command.add_option("--jobs", options.jobs, "how many threads")->check(CLI::Range(1, 1024));
  command.add_option("--seed", options.seed, "of the trials' errors")->capture_default_str();
  command
      .add_option("--grasp", options.grasp,
                  "how the gripper holds parts: friction or weld (the default)")
      ->transform(CLI::CheckedTransformer(std::map<std::string, scene::GraspMode>{
          {"friction", scene::GraspMode::kFriction}, {"weld", scene::GraspMode::kWeld}}));
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("scenario", options->scenario, "scenario file with an assembled goal")
      ->required();
  AddUncertainty(command, *options);
  AddTrials(command, *options);
  command.add_option("--pictures", options->pictures,
                     "folder for pictures of the contact states and their graph; index.html has "
                     "all of it");
  command.add_flag("--json", options->json, "print the result as JSON");
  command.add_option("--models", options->models, "folder with parts/ and workcells/")
      ->check(CLI::ExistingDirectory);
  return [options] { return Execute(*options); };
}

}  // namespace

const Verb kMate = {
    .name = "mate",
    .summary = "plans the fine motion of one mating, and tries it in physics",
    .example = "assay mate scenarios/mate-square.yaml --trials 20",
    .declare = Declare,
};

}  // namespace assay::cli
