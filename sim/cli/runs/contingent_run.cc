#include "sim/cli/runs/contingent_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "planner/contingent/plan_tree/tree_text.h"
#include "planner/plan/plan_files/json_layout.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/interruption.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/stopwatch.h"
#include "sim/cli/picture_output/step_pictures.h"
#include "sim/cli/plan_output/plan_text.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/cli/tasks/planned_problem.h"
#include "sim/cli/tasks/tree_worlds.h"
#include "sim/cli/tree_output/contingent_report.h"
#include "sim/cli/tree_output/goal_conflict_text.h"
#include "sim/cli/tree_output/plan_tree_report.h"
#include "sim/cli/tree_output/tree_trial_report.h"
#include "sim/execution/interpretation/knowledge_scenario.h"
#include "sim/execution/interpretation/plan_interpretation.h"
#include "sim/execution/trial/scheduler.h"
#include "sim/scenario/models_folder.h"

namespace assay::cli {
namespace {

using execution::KnowledgeScenario;
using execution::TreeTrial;
using Json = nlohmann::ordered_json;

// A scenario's plan tree and its trials.
class RunningTrees {
 public:
  RunningTrees(const ContingentRun& run, const KnowledgeScenario& scenario,
               const contingent::PlanTree& tree)
      : run_(run),
        scenario_(scenario),
        tree_(tree),
        seed_(run.command.seed.value_or(scenario.scenario.simulation.seed)),
        worlds_(scenario, tree, seed_, run.command.worlds == "all"),
        study_{.command = run.command.Again(seed_, std::nullopt),
               .can_spill = scenario.interpretation.spill.has_value(),
               .leaves = worlds_.leaves(),
               .unreachable = worlds_.unreachable()} {
    if (const auto& planned = scenario.interpretation.planned) {
      study_.words = ActionWords(planned->worlds, planned->assembly);
    }
  }

  ExitCode Execute() {
    const std::vector<int> numbers = Numbers();
    const Interruption interruption;
    execution::Scheduler(run_.jobs, Interruption::Requested)
        .InOrder(
            numbers.size(), [&](std::size_t i) { return Run(numbers[i], i == 0 && run_.renders); },
            [&](std::size_t, TreeTrial trial) {
              study_.trials.push_back(std::move(trial));
              progress_->Tell({std::ssize(study_.trials), std::ssize(numbers), "trials"});
            });
    progress_.reset();
    study_.seconds = stopwatch_.Seconds();
    const Json printed = Result();
    Json result = printed;
    result.erase("seconds");
    const std::string text =
        TextOf(study_) + Interruption::Text(std::ssize(study_.trials), std::ssize(numbers));
    PrintAndWrite(run_.json ? plan::JsonText(printed) : text, [&] {
      if (!run_.folder.empty()) WriteFile(run_.folder / "result.json", plan::JsonText(result));
    });
    return Interruption::CodeOr(study_.Failed() == 0 ? ExitCode::kDone : ExitCode::kFailed);
  }

 private:
  Json Result() const {
    Json json = ToJson(study_);
    if (Interruption::Requested()) json["interrupted"] = true;
    return json;
  }

  std::vector<int> Numbers() const {
    if (run_.command.trial) return {*run_.command.trial};
    const int usual = std::max(1, static_cast<int>(worlds_.reachable_count()));
    std::vector<int> numbers(static_cast<std::size_t>(run_.trials.value_or(usual)));
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<int>(i) + 1;
    return numbers;
  }

  TreeTrial Run(int number, bool is_pictured) const {
    execution::TrialSettings settings{.seed = seed_, .sensing_errors = run_.command.sensing_errors};
    std::optional<StepPictures> pictures;
    if (is_pictured) {
      settings.on_step_end = [&](const execution::StepPicture& step) { Take(step, pictures); };
    }
    TreeTrial trial =
        execution::RunTrial(scenario_, tree_, {number, worlds_.WorldOf(number)}, settings);
    if (pictures) pictures->Write(run_.folder);
    return trial;
  }

  void Take(const execution::StepPicture& step, std::optional<StepPictures>& pictures) const {
    if (pictures) return pictures->TakeStepEnd(step.action, step.data);
    pictures.emplace(PicturedPlan{scenario_.scenario.problem, kNoPlan, step.scene},
                     scenario_.scenario.simulation.cameras, run_.pictures);
    pictures->SeeStart(step.data);
  }

  static const plan::Plan kNoPlan;

  const ContingentRun& run_;
  const KnowledgeScenario& scenario_;
  const contingent::PlanTree& tree_;
  const std::uint64_t seed_;
  const TreeWorlds worlds_;
  TreeStudy study_;
  const Stopwatch stopwatch_;
  std::unique_ptr<Progress> progress_ = std::make_unique<Progress>("enacting");
};

const plan::Plan RunningTrees::kNoPlan = {};

// Reports an assembly without a plan in the same form as `assay plan`.
ExitCode RefuseAssembly(const execution::PlannedWorlds& planned, const ContingentRun& run) {
  const Json json = {{"outcome", planned.assembly.outcome == Outcome::kNone ? "none" : "budget"},
                     {"plan", ToJson(planned.worlds, planned.assembly)}};
  Print(run.json ? plan::JsonText(json) : Text(planned.worlds, planned.assembly));
  return ExitCodeOf(planned.assembly.outcome);
}

// Prints the first plan of an assembly's tree in which the independent checker finds flaws. Returns
// false if there is none.
bool PrintedFlaws(const execution::PlannedWorlds& planned, const ContingentRun& run) {
  for (const assembly::PlanOfWorlds& of_worlds : planned.assembly.plans) {
    for (const int world : of_worlds.worlds) {
      const plan::CheckReport check =
          CheckPlan(planned.worlds[static_cast<std::size_t>(world)], of_worlds.plan);
      if (check.flaws.empty()) continue;
      Print(run.json ? plan::JsonText({{"check", ToJson(of_worlds.plan, check)}})
                     : Text(of_worlds.plan, check));
      return true;
    }
  }
  return false;
}

// Reports that no plan was found for a goal of knowledge, as `assay plan` does.
ExitCode RefuseKnowledge(const ContingentAnswer& answer, const ContingentRun& run) {
  Json json = {{"outcome", Name(answer.plan.outcome, "planned")}, {"not_served", answer.unserved}};
  if (answer.conflict) json["conflict"] = ToJson(answer.task, *answer.conflict);
  Print(run.json ? plan::JsonText(json) : Text(answer, false, kKnowledgeStates));
  return ExitCodeOf(answer.plan.outcome);
}

}  // namespace

ExitCode RunContingent(const ContingentRun& run) {
  const KnowledgeScenario scenario = execution::Load(
      run.command.input, scenario::FindModels(run.command.input, run.command.models));
  const ContingentAnswer answer = TreeOf(scenario.interpretation);
  const auto& planned = scenario.interpretation.planned;
  if (planned && PrintedFlaws(*planned, run)) return ExitCode::kFailed;
  if (answer.plan.outcome == Outcome::kFound) {
    return RunningTrees(run, scenario, answer.plan.tree).Execute();
  }
  if (planned) return RefuseAssembly(*planned, run);
  return RefuseKnowledge(answer, run);
}

}  // namespace assay::cli
