#include "sim/cli/shown_executions/tree_trial_execution.h"

#include <map>
#include <utility>

#include "sim/cli/shown_executions/tree_lines.h"
#include "sim/cli/tree_output/plan_tree_report.h"
#include "sim/execution/interpretation/planned_worlds.h"

namespace assay::cli {
namespace {

using execution::KnowledgeScenario;
using execution::PlannedWorlds;
using execution::TreeTrial;

// Returns the step of a world's plan that an action of the tree is; none if it is another action.
plan::StepId StepOf(const std::string& action, const PlannedWorlds* planned, int world) {
  if (planned == nullptr) return plan::StepId::None();
  const auto found = planned->assembly.knowledge.actions.find(action.substr(0, action.find('(')));
  if (found == planned->assembly.knowledge.actions.end()) return plan::StepId::None();
  const assembly::KnowledgeAction& known = found->second;
  const bool is_step = known.kind == assembly::KnowledgeAction::Kind::kStep &&
                       &planned->assembly.plans[known.plan].plan == planned->PlanOf(world);
  return is_step ? known.step : plan::StepId::None();
}

view::Way WayOf(const KnowledgeScenario& scenario, const contingent::PlanTree& tree,
                const TreeTrial& trial) {
  const PlannedWorlds* const planned = scenario.interpretation.planned.get();
  std::map<std::string, std::string> words;
  if (planned != nullptr) words = ActionWords(planned->worlds, planned->assembly);
  view::Way way{.lines = TreeLines(scenario.interpretation.task, tree, trial.walk, words),
                .actions = {}};
  for (const execution::WalkedStep& step : trial.walk.steps) {
    const auto found = words.find(step.action);
    way.actions.push_back({found == words.end() ? step.action : found->second,
                           StepOf(step.action, planned, trial.world.world), step.end});
  }
  return way;
}

}  // namespace

ShownExecution TreeTrialExecution(const KnowledgeScenario& scenario,
                                  const contingent::PlanTree& tree, TreeTrial trial,
                                  const std::string& source, const std::string& file) {
  const PlannedWorlds* const planned = scenario.interpretation.planned.get();
  const int world = trial.world.world;
  ShownExecution shown{
      .problem = planned == nullptr ? scenario.scenario.problem : planned->worlds[world],
      .plan = planned == nullptr ? plan::Plan{} : *planned->PlanOf(world),
      .scene = trial.scene,
      .trace = std::move(trial.trace),
      .outcome = std::string(trial.OutcomeName()),
      .reason = trial.reason,
      .way = WayOf(scenario, tree, trial),
      .source = source,
      .plan_file = file};
  if (trial.IsFailed()) shown.code = ExitCode::kFailed;
  return shown;
}

}  // namespace assay::cli
