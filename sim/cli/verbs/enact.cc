#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>

#include "planner/contingent/search/contingent_planner.h"
#include "planner/contingent/search/goal_conflict.h"
#include "planner/contingent/tree/tree_text.h"
#include "planner/plan/file/json_layout.h"
#include "sim/cli/options/models_folder.h"
#include "sim/cli/options/quantity_option.h"
#include "sim/cli/pictures/film.h"
#include "sim/cli/plans/goal_conflict_text.h"
#include "sim/cli/plans/plan_tree_report.h"
#include "sim/cli/program/console.h"
#include "sim/cli/program/interruption.h"
#include "sim/cli/program/progress.h"
#include "sim/cli/program/stopwatch.h"
#include "sim/cli/program/usage_error.h"
#include "sim/cli/program/verb.h"
#include "sim/cli/trials/enactment_report.h"
#include "sim/cli/work/output_file.h"
#include "sim/cli/work/trial.h"
#include "sim/enact/walk/knowledge_scenario.h"
#include "sim/enact/walk/plan_interpretation.h"
#include "sim/scenario/models_folder.h"

namespace assay::cli {
namespace enact_verb {

using enact::EnactedTrial;
using enact::KnowledgeScenario;
using Json = nlohmann::ordered_json;

constexpr std::int64_t kBudget = 10'000'000;  // knowledge states that the planner may examine

struct Options {
  std::filesystem::path scenario;
  domain::ModelPath models;
  std::optional<int> trials;
  std::optional<int> trial;  // the only trial to run
  int jobs = 1;
  std::optional<std::uint64_t> seed;
  std::string worlds = "drawn";
  double sensing_errors = 0;
  std::filesystem::path pictures;
  PictureOptions picture;
  bool json = false;
};

// A scenario's plan tree and its trials.
class Enacting {
 public:
  Enacting(const Options& options, const KnowledgeScenario& scenario,
           const contingent::PlanTree& tree)
      : options_(options),
        scenario_(scenario),
        tree_(tree),
        seed_(options.seed.value_or(scenario.scenario.simulation.seed)),
        study_{.scenario = options.scenario.string(),
               .models = options.models,
               .seed = seed_,
               .sensing_errors = options.sensing_errors,
               .is_every_leaf = options.worlds == "all",
               .can_spill = scenario.interpretation.spill.has_value(),
               .leaves = enact::LeavesOf(scenario.interpretation.task, tree, kMostLeaves)} {
    if (study_.leaves.size() == kMostLeaves) {
      throw UsageError(fmt::format("enact: the tree has {} leaves or more", kMostLeaves));
    }
    if (const auto& planned = scenario.interpretation.planned) {
      study_.words = ActionWords(planned->worlds, planned->assembly);
    }
    FindWorlds();
  }

  ExitCode Execute() {
    const std::vector<int> numbers = Numbers();
    study_.trials.resize(numbers.size());
    const Interruption interruption;
    ForEachTrial(static_cast<int>(numbers.size()), options_.jobs, [&](int nth) {
      const int number = numbers[static_cast<std::size_t>(nth - 1)];
      const bool is_pictured = nth == 1 && !options_.pictures.empty();
      study_.trials[static_cast<std::size_t>(nth - 1)] = Run(number, is_pictured);
      const std::lock_guard lock(mutex_);
      progress_->Tell(fmt::format("enacting, {} of {} trials", ++done_, numbers.size()));
    });
    progress_.reset();
    // Trials that were not made have the number 0.
    std::erase_if(study_.trials, [](const EnactedTrial& trial) { return trial.number == 0; });
    study_.seconds = stopwatch_.Seconds();
    Json json = ToJson(study_);
    if (Interruption::Requested()) json["interrupted"] = true;
    Print(options_.json ? plan::JsonText(json)
                        : TextOf(study_) +
                              Interruption::Text(std::ssize(study_.trials), std::ssize(numbers)));
    return Interruption::CodeOr(study_.Failed() == 0 ? ExitCode::kDone : ExitCode::kFailed);
  }

 private:
  static constexpr std::size_t kMostLeaves = 10'000;

  // With --worlds all, finds the leaves that a hidden world leads to, as indices among all leaves.
  void FindWorlds() {
    if (!study_.is_every_leaf) return;
    study_.unreachable.resize(study_.leaves.size());
    for (std::size_t i = 0; i < study_.leaves.size(); ++i) {
      RandomStream random(seed_, "reachable");
      const auto found = enact::FindWorld(study_.leaves[i], scenario_.interpretation,
                                          scenario_.scenario.problem, random);
      if (const auto* why = std::get_if<std::string>(&found)) {
        study_.unreachable[i] = *why;
      } else {
        reachable_.push_back(i);
      }
    }
    if (reachable_.empty()) {
      throw UsageError(fmt::format("enact: no hidden world leads to a leaf of the tree: {}",
                                   study_.unreachable.front()));
    }
  }

  std::optional<enact::HiddenWorld> WorldFor(std::size_t leaf, RandomStream& random) const {
    return enact::WorldFor(study_.leaves[leaf], scenario_.interpretation,
                           scenario_.scenario.problem, random);
  }

  std::vector<int> Numbers() const {
    if (options_.trial) return {*options_.trial};
    const int usual = reachable_.empty() ? 1 : static_cast<int>(reachable_.size());
    std::vector<int> numbers(static_cast<std::size_t>(options_.trials.value_or(usual)));
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<int>(i) + 1;
    return numbers;
  }

  // With --worlds all, the trials go through the leaves in turn.
  enact::HiddenWorld WorldOf(int number) const {
    RandomStream random(seed_, fmt::format("hidden world {}", number));
    if (reachable_.empty())
      return enact::DrawnWorld(scenario_.interpretation.hidden,
                               scenario_.interpretation.WorldCount(), random);
    const std::size_t leaf = reachable_[static_cast<std::size_t>(number - 1) % reachable_.size()];
    return WorldFor(leaf, random).value();
  }

  EnactedTrial Run(int number, bool is_pictured) const {
    enact::TrialSettings settings{.seed = seed_, .sensing_errors = options_.sensing_errors};
    std::optional<Film> film;
    settings.on_step_end = [&](const enact::StepPicture& step) {
      if (is_pictured) Take(step, film);
      Interruption::BreakOffIfRequested();
    };

    EnactedTrial trial = enact::RunTrial(scenario_, tree_, {number, WorldOf(number)}, settings);
    if (film) film->Write(options_.pictures);
    return trial;
  }

  void Take(const enact::StepPicture& step, std::optional<Film>& film) const {
    if (film) return film->TakeStepEnd(step.action, step.data);
    film.emplace(FilmSubject{scenario_.scenario.problem, kNoPlan, step.scene},
                 scenario_.scenario.simulation.cameras, options_.picture);
    film->TakeStart(step.data);
  }

  static const plan::Plan kNoPlan;

  const Options& options_;
  const KnowledgeScenario& scenario_;
  const contingent::PlanTree& tree_;
  const std::uint64_t seed_;
  EnactmentStudy study_;
  std::vector<std::size_t> reachable_;
  const Stopwatch stopwatch_;
  std::mutex mutex_;
  int done_ = 0;
  std::unique_ptr<Progress> progress_ = std::make_unique<Progress>("enacting");
};

const plan::Plan Enacting::kNoPlan = {};

// Reports an assembly without a plan in the same form as `assay plan`.
ExitCode RefuseAssembly(const enact::PlannedWorlds& planned, const Options& options) {
  const Json json = {{"outcome", planned.assembly.outcome == Outcome::kNone ? "none" : "budget"},
                     {"plan", ToJson(planned.worlds, planned.assembly)}};
  Print(options.json ? plan::JsonText(json) : Text(planned.worlds, planned.assembly));
  return ExitCodeOf(planned.assembly.outcome);
}

// Actions that no grasp serves are reported as well, because they may be the reason.
ExitCode RefuseKnowledge(const enact::Interpretation& interpretation,
                         const contingent::ContingentPlan& plan, const Options& options) {
  const bool is_none = plan.outcome == Outcome::kNone;
  Json json = {{"outcome", is_none ? "none" : "budget"}, {"not_served", interpretation.unserved}};
  std::string text = NotFoundText(plan, kBudget);
  if (is_none) {
    Budget budget(kBudget);
    const auto conflict = contingent::FindGoalConflict(interpretation.task, budget);
    json["conflict"] = ToJson(interpretation.task, conflict);
    text = Text(interpretation.task, conflict);
  }
  if (!interpretation.unserved.empty()) text += "No grasp serves:\n";
  for (const std::string& unserved : interpretation.unserved) text += "  " + unserved + "\n";
  Print(options.json ? plan::JsonText(json) : text);
  return ExitCodeOf(plan.outcome);
}

ExitCode Refuse(const enact::Interpretation& interpretation, const contingent::ContingentPlan& plan,
                const Options& options) {
  if (interpretation.planned) return RefuseAssembly(*interpretation.planned, options);
  return RefuseKnowledge(interpretation, plan, options);
}

// Returns the tree of an assembly, which is made already, or plans one.
contingent::ContingentPlan PlanOf(const enact::Interpretation& interpretation) {
  if (interpretation.planned) {
    contingent::ContingentPlan plan;
    plan.outcome = interpretation.planned->assembly.outcome;
    plan.tree = interpretation.planned->assembly.tree;
    return plan;
  }
  Budget budget(kBudget);
  return MakePlan(interpretation.task, contingent::Wanted::kFirst, budget);
}

ExitCode Execute(const Options& options) {
  if (!options.pictures.empty()) MakeFolder(options.pictures);
  const KnowledgeScenario scenario =
      enact::Load(options.scenario, scenario::FindModels(options.scenario, options.models));
  const contingent::ContingentPlan plan = PlanOf(scenario.interpretation);
  if (plan.outcome != Outcome::kFound) return Refuse(scenario.interpretation, plan, options);
  return Enacting(options, scenario, plan.tree).Execute();
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command
      .add_option("scenario", options->scenario,
                  "scenario file: with the key `knowledge`, or of an assembly")
      ->required();
  command
      .add_option("--trials", options->trials,
                  "so many; 1 if left out, with --worlds all one for each leaf of the tree")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  command.add_option("--trial", options->trial, "run only this one of the trials")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  command.add_option("--jobs", options->jobs, "how many threads")->check(CLI::Range(1, 1024));
  command.add_option("--seed", options->seed, "of all that is random; the scenario's if left out");
  command
      .add_option(
          "--worlds", options->worlds,
          "drawn: what is hidden is drawn; all: for each leaf and repeat of the tree in turn, "
          "from what leads there, with mishaps where errors do")
      ->check(CLI::IsMember({"drawn", "all"}))
      ->capture_default_str();
  command
      .add_option(
          "--sensing-errors", options->sensing_errors,
          "with this probability what is sensed is made wrong: what a branch or the goal asks, "
          "and numbers that are read")
      ->check(Within({0, 1}, domain::kRatio));
  command.add_option("--pictures", options->pictures,
                     "folder for pictures of the first trial: its start and the end of each step");
  AddPictureOptions(command, options->picture, "--pictures");
  command.add_flag("--json", options->json, "print the result as JSON");
  AddModelsOption(command, options->models);
  return [options] { return Execute(*options); };
}

}  // namespace enact_verb

const Verb kEnact = {
    .name = "enact",
    .summary = "plans with what will be known, walks the tree in physics and audits what is known",
    .example = "assay enact scenarios/two-cans.yaml --worlds all",
    .declare = enact_verb::Declare,
};

}  // namespace assay::cli
