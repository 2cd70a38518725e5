#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>

#include "planner/assembly/strategy_reach.h"
#include "planner/domain/matings/mating_classes.h"
#include "planner/domain/matings/mating_errors_file.h"
#include "planner/finemotion/strategy_search/likely_errors.h"
#include "planner/plan/plan_files/json_layout.h"
#include "sim/check/contact_sequences/margin_ranking.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/interruption.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/stopwatch.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/command_line/verb.h"
#include "sim/cli/mating_output/contact_chain_report.h"
#include "sim/cli/mating_output/fine_motion_report.h"
#include "sim/cli/mating_output/mating_report.h"
#include "sim/cli/options/models_folder.h"
#include "sim/cli/options/quantity.h"
#include "sim/cli/options/quantity_option.h"
#include "sim/cli/page_output/mating_page.h"
#include "sim/cli/picture_output/mating_pictures.h"
#include "sim/cli/tasks/mating_task.h"
#include "sim/cli/tasks/mating_trials.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/execution/trial/scheduler.h"
#include "sim/sweep/shell_commands/shell.h"

namespace assay::cli {
namespace mate_verb {

using Json = nlohmann::ordered_json;
using finemotion::FineMotionPlan;
using finemotion::MatingGeometry;

constexpr int kMostNodes = 1'000'000;

struct Options {
  std::filesystem::path scenario;
  domain::ModelPath models;
  std::optional<double> displacement_mm;
  std::optional<double> rotation_deg;
  std::optional<double> velocity;  // direction error, a share of the motion
  std::optional<double> clearance_mm;
  std::optional<double> friction;
  double beyond = 1;
  int trials = 0;
  std::optional<int> trial;  // the only trial to run
  int jobs = 1;
  std::uint64_t seed = 1;
  std::uint64_t search_seed = 1;
  int nodes = finemotion::StrategyOptions().thorough_nodes;
  finemotion::MeetingTest intersection = finemotion::MeetingTest::kExact;
  scene::GraspMode grasp = scene::GraspMode::kWeld;
  std::filesystem::path pictures;  // folder
  std::filesystem::path page;      // HTML file
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
  if (options.clearance_mm) overrides.clearance = *options.clearance_mm * kLengthUnit.factor;
  const Document document = Document::Load(options.scenario);
  return MakePlan(document, scenario::Read(document, options.models, overrides), {}, {});
}

domain::MatingErrors HalfWidths(const Options& options, const domain::Problem& problem) {
  domain::MatingErrors errors = problem.mating_errors;
  if (options.displacement_mm) errors.displacement = *options.displacement_mm * kLengthUnit.factor;
  if (options.rotation_deg) errors.rotation = *options.rotation_deg * kDegree;
  if (options.velocity) errors.velocity = *options.velocity;
  return errors;
}

finemotion::FineMotionErrors ErrorsOf(const domain::MatingErrors& half_widths,
                                      const MatingGeometry& geometry) {
  finemotion::FineMotionErrors errors;
  errors.tolerances = geometry.tolerances;
  errors.pose.head<3>().setConstant(half_widths.displacement);
  errors.pose.tail<3>().setConstant(half_widths.rotation);
  errors.velocity = half_widths.velocity;
  return errors;
}

finemotion::StrategyOptions SearchOptions(const Options& options, double usual_friction) {
  return {.friction = options.friction.value_or(usual_friction),
          .thorough_nodes = options.nodes,
          .test = options.intersection,
          .seed = options.search_seed};
}

// Returns the command that repeats a trial when the trial's number is added.
std::string ReplayCommand(const Options& options) {
  const Options usual;
  sweep::CommandLine line("mate", options.scenario);
  line.AddIfGiven("--displacement", options.displacement_mm);
  line.AddIfGiven("--rotation", options.rotation_deg);
  line.AddIfGiven("--velocity", options.velocity);
  line.AddIfGiven("--clearance", options.clearance_mm);
  line.AddIfGiven("--friction", options.friction);
  line.AddUnless(usual.beyond, "--beyond", options.beyond);
  for (const auto& [name, test] : Intersections()) {
    if (test == options.intersection) line.AddUnless(std::string("exact"), "--intersection", name);
  }
  line.AddUnless(usual.seed, "--seed", options.seed);
  line.AddUnless(usual.search_seed, "--search-seed", options.search_seed);
  line.AddUnless(usual.nodes, "--nodes", options.nodes);
  line.AddUnless(scene::Name(usual.grasp), "--grasp", scene::Name(options.grasp));
  line.AddModels(options.models);
  return line.text() + " --trial ";
}

std::vector<int> NumbersOf(const Options& options) {
  if (options.trial) return {*options.trial};
  std::vector<int> numbers(static_cast<std::size_t>(options.trials));
  std::iota(numbers.begin(), numbers.end(), 1);
  return numbers;
}

// A mating with its plan and the output about it.
struct Planning {
  MatingTask task;
  MatingGeometry geometry;
  finemotion::FineMotionErrors errors;
  finemotion::StrategyOptions search;
  finemotion::ContactChain chain = {};
  FineMotionPlan plan = {};
  plan::Strategy strategy = {};  // the strategy of `plan`
  std::optional<MatingStudy> study = {};

  Json json = {};
  std::string text = {};
  ExitCode code = ExitCode::kNoPlan;
};

Planning Prepared(const Options& options) {
  MatingTask task = LastMatingOf(Planned(options));
  const domain::Problem& problem = task.planned.problem;
  const domain::Mating& mating = problem.mating(task.assemble.mating);
  MatingGeometry geometry = finemotion::GeometryOf(problem, mating);
  const finemotion::FineMotionErrors errors = ErrorsOf(HalfWidths(options, problem), geometry);
  const auto search = SearchOptions(options, domain::GreatestMatingFriction(problem, mating));
  return {std::move(task), std::move(geometry), errors, search};
}

void Search(Planning& of) {
  const Progress progress("planning the mating");
  Json seconds;
  const Stopwatch graphing;
  of.chain = ContactChainOf(of.geometry);
  seconds["graph"] = graphing.Seconds();
  const Stopwatch searching;
  of.plan = SearchStrategy(of.geometry.passage, of.errors, of.search);
  seconds["search"] = searching.Seconds();
  of.strategy = StrategyOf(of.geometry, of.plan, of.search);
  TellLikelyErrors(of.geometry, of.plan, of.errors, of.search, of.strategy);
  of.json = ToJson(of.geometry, of.plan);
  of.json.update(ToJson(of.chain, of.plan));
  of.json["seconds"] = seconds;
  of.text = TextOf(of.geometry, of.plan, of.search) + TextOf(of.chain, of.plan);
  of.code = ExitCodeOf(of.plan.outcome);
}

MatingTrialSettings TrialSettings(const Planning& of, const kinematics::JointVector& near,
                                  const Options& options) {
  MatingTrialSettings settings{.errors = of.errors,
                               .beyond = options.beyond,
                               .scene = of.task.planned.simulation.scene,
                               .seed = options.seed,
                               .near = near};
  settings.scene.grasp = options.grasp;
  if (options.friction) settings.scene.part_friction = *options.friction;
  return settings;
}

MatingStudy Tried(const Planning& of, const kinematics::JointVector& near, const Options& options) {
  Progress progress("mating in physics");
  const MatingTrialSettings settings = TrialSettings(of, near, options);
  const MatingTrials trials(of.task, of.geometry, of.strategy, settings);
  const check::PlannedContacts contacts = check::PlannedContactsOf(of.plan);
  const std::vector<int> numbers = NumbersOf(options);
  MatingStudy study{.strategy = {},
                    .straight = {},
                    .covered = of.plan.absorbed,
                    .replay = ReplayCommand(options)};
  const Interruption interruption;
  execution::Scheduler(options.jobs, Interruption::Requested)
      .InOrder(
          numbers.size(),
          [&](std::size_t i) {
            MatedTrial strategy = trials.RunStrategy(numbers[i], contacts);
            return std::pair(std::move(strategy), trials.RunStraight(numbers[i]));
          },
          [&](std::size_t i, std::pair<MatedTrial, MatedTrial> made) {
            study.strategy.push_back(std::move(made.first));
            study.straight.push_back(std::move(made.second));
            progress.Tell({static_cast<int>(i) + 1, std::ssize(numbers), "trials"});
          });
  std::vector<check::SequenceComparison> comparisons;
  for (const MatedTrial& trial : study.strategy) comparisons.push_back(trial.sequence->comparison);
  study.ranking = check::RankMargins(of.geometry.passage, of.plan, of.search.reach, comparisons);
  return study;
}

// Warns that a strategy is certain only if the fixed part stays where it is.
std::string FreeText(const Planning& of) {
  const domain::Problem& problem = of.task.planned.problem;
  const domain::Part& fixed = problem.part(problem.mating(of.task.assemble.mating).fixed);
  if (fixed.clamp > 0) return "";
  return fmt::format(
      "only its weight holds {0}, so pushes may move it; declare a fixture with the key `clamp` of "
      "{0} in the scenario, in newtons\n",
      fixed.name);
}

void Try(const kinematics::JointVector& near, const Options& options, Planning& of) {
  if (options.trials == 0 && !options.trial) return;
  const Stopwatch trying;
  of.study = Tried(of, near, options);
  of.json["seconds"]["trials"] = trying.Seconds();
  of.text += TextOf(*of.study);
  of.text += Interruption::Text(std::ssize(of.study->strategy), std::ssize(NumbersOf(options)));
  of.json["trials"] = ToJson(*of.study);
  if (Interruption::Requested()) of.json["interrupted"] = true;
  if (!of.plan.found() || of.study->CoveredFailures() == 0) return;
  of.code = ExitCode::kFailed;
  of.text += FreeText(of);
}

void View(const kinematics::JointVector& near, const Options& options, Planning& of) {
  if (options.page.empty() || Interruption::Requested()) return;
  const double rate = execution::ExecutorOptions().sample_rate;
  const int number = options.trial.value_or(1);
  const MatingTrialSettings settings = TrialSettings(of, near, options);
  const MatingTrials trials(of.task, of.geometry, of.strategy, settings);
  const MatedTrial strategy = trials.RunStrategy(number, check::PlannedContactsOf(of.plan), rate);
  const MatedTrial straight = trials.RunStraight(number, rate);
  WriteFile(options.page, MatingPage({of.task, of.geometry, of.chain, of.plan, settings.scene,
                                      strategy, straight}));
  of.json["page"] = options.page.string();
  of.text += options.page.string() + "\n";
}

// A strategy that the arm cannot execute proves nothing: it may be able to execute another
// strategy, or the same one with the parts in other places.
void Refuse(const assembly::Unreached& unreached, Planning& of) {
  of.code = ExitCode::kBudgetSpent;
  of.json["outcome"] = "budget";
  of.json["unreached"] = ToJson(of.task, unreached);
  of.text += TextOf(of.task, unreached);
}

void Execute(const Options& options, Planning& of) {
  plan::Hold& hold = of.task.assemble.hold;
  const auto chosen = assembly::ChooseHold(of.task.planned.problem, of.task.assemble, of.strategy);
  if (const auto* unreached = std::get_if<assembly::Unreached>(&chosen)) {
    if (of.plan.found()) Refuse(*unreached, of);
    return;
  }
  const auto& [reaching, start] = std::get<assembly::ReachingHold>(chosen);
  if (reaching.grasp != hold.grasp)
    of.text += fmt::format("held with grasp {}; with {} the arm does not reach all motions\n",
                           reaching.grasp, hold.grasp);
  hold = reaching;
  of.json["grasp"] = hold.grasp;
  Try(start, options, of);
  View(start, options, of);
}

void Picture(const std::filesystem::path& folder, Planning& of) {
  const Progress progress("drawing contact states");
  const PlannedProblem& planned = of.task.planned;
  const std::vector<std::string> files =
      WriteMatingPictures(folder, {planned, planned.problem.mating(of.task.assemble.mating),
                                   of.geometry, of.chain, of.plan, of.strategy, of.study});
  of.json["pictures"] = files;
  of.text += fmt::format("{}\n", fmt::join(files, "\n"));
}

ExitCode Execute(const Options& options) {
  if (!options.pictures.empty()) MakeFolder(options.pictures);
  if (!options.page.empty()) RequireWritable(options.page);
  Planning planning = Prepared(options);
  Search(planning);
  if (!planning.plan.motions.empty()) {
    Execute(options, planning);
    if (!options.pictures.empty() && !Interruption::Requested()) {
      Picture(options.pictures, planning);
    }
  }
  Print(options.json ? plan::JsonText(planning.json) : planning.text);
  return Interruption::CodeOr(planning.code);
}

void AddUncertainty(CLI::App& command, Options& options) {
  command
      .add_option("--displacement", options.displacement_mm,
                  "greatest displacement of the held part along each of x, y and z, in mm, instead "
                  "of the scenario's mating_errors")
      ->check(Within(domain::kMatingDisplacements, kLengthUnit));
  command
      .add_option("--rotation", options.rotation_deg,
                  "greatest rotation of the held part about each of x, y and z, in degrees")
      ->check(Within(domain::kMatingRotations, kAngleUnit));
  command
      .add_option("--velocity", options.velocity,
                  "greatest error of a motion at its end, as a share of its length: 0.002 is 0.2 %")
      ->check(Within(domain::kMatingVelocities, kRatioUnit));
  command
      .add_option("--clearance", options.clearance_mm,
                  "gap on each side in mm, instead of the scenario's")
      ->check(Within({0, 0.1}, kLengthUnit));
  command
      .add_option("--friction", options.friction,
                  "friction of the parts, instead of the value in the part files")
      ->check(Within({0, 10}, kRatioUnit));
  command
      .add_option("--intersection", options.intersection,
                  "how the planner decides whether a motion with errors can meet a contact: exact "
                  "(the default), edges (the test of Dakin and Popplestone, which misses some "
                  "contacts), or compare (exact, and counts what edges misses)")
      ->transform(CLI::CheckedTransformer(Intersections()));
  command
      .add_option("--search-seed", options.search_seed, "seed of the random numbers in planning")
      ->capture_default_str();
  command
      .add_option("--nodes", options.nodes,
                  "limit of nodes for each critical point in the search through all sequences of "
                  "contacts; if the limit is reached, the exit code is 11")
      ->check(CLI::Range(1, kMostNodes))
      ->capture_default_str();
}

void AddTrials(CLI::App& command, Options& options) {
  command
      .add_option("--trials", options.trials,
                  "number of trials of the strategy; each is compared with a straight motion")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()));
  command.add_option("--trial", options.trial, "run only the trial with this number")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  command
      .add_option("--beyond", options.beyond,
                  "factor by which the box of errors in the trials is wider than the planned box")
      ->check(Within({0, 100}, kRatioUnit))
      ->capture_default_str();
  command.add_option("--jobs", options.jobs, "number of threads")->check(CLI::Range(1, 1024));
  command.add_option("--seed", options.seed, "seed of the errors in the trials")
      ->capture_default_str();
  command
      .add_option("--grasp", options.grasp,
                  "how the gripper holds the part: friction or weld (the default)")
      ->transform(CLI::CheckedTransformer(std::map<std::string, scene::GraspMode>{
          {"friction", scene::GraspMode::kFriction}, {"weld", scene::GraspMode::kWeld}}));
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("scenario", options->scenario, "scenario file whose goal has an assembly")
      ->required();
  AddUncertainty(command, *options);
  AddTrials(command, *options);
  command.add_option("--pictures", options->pictures,
                     "folder for pictures of the contact states and their graphs, and for a page "
                     "with all of them, index.html");
  command.add_option("--view", options->page,
                     "HTML file for a page that shows the trial of --trial, or the first one, with "
                     "its contact states and the errors that are left");
  command.add_flag("--json", options->json, "print the result as JSON");
  AddModelsOption(command, options->models);
  return [options] { return Execute(*options); };
}

}  // namespace mate_verb

const Verb kMate = {
    .name = "mate",
    .summary = "plans the fine motion of one mating, and executes it in physics",
    .page = "planner/fine-motion.md",
    .example = "assay mate scenarios/mate-square.yaml --trials 20",
    .declare = mate_verb::Declare,
};

}  // namespace assay::cli
