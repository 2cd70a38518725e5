#include <fmt/format.h>

#include "planner/base/input_files/quotation.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/page_output/tree_lines.h"
#include "sim/cli/page_output/viewed_page.h"
#include "sim/cli/tasks/tree_worlds.h"
#include "sim/cli/tree_output/plan_tree_report.h"
#include "sim/execution/interpretation/planned_worlds.h"
#include "sim/execution/trial/tree_trial.h"
#include "sim/scenario/models_folder.h"

namespace assay::cli {
namespace {

using execution::KnowledgeScenario;
using execution::PlannedWorlds;
using execution::TreeTrial;

TreeTrial Enacted(const KnowledgeScenario& scenario, const contingent::PlanTree& tree,
                  const ViewRequest& request) {
  const Progress progress("executing the plan tree for " + scenario.scenario.problem.name);
  const std::uint64_t seed = scenario.scenario.simulation.seed;
  const int number = request.number.value_or(1);
  const TreeWorlds worlds(scenario, tree, seed, request.is_every_leaf);
  return execution::RunTrial(
      scenario, tree, {number, worlds.WorldOf(number)},
      {.seed = seed, .sample_rate = execution::ExecutorOptions().sample_rate});
}

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

ViewedPage TreePage(const ViewRequest& request) {
  const KnowledgeScenario scenario =
      execution::Load(request.input, scenario::FindModels(request.input, request.models));
  const contingent::ContingentPlan plan = TreeOf(scenario.interpretation).plan;
  if (plan.outcome != Outcome::kFound) {
    throw UsageError(fmt::format("view: there is no plan tree for {} (see assay plan)",
                                 Quote(request.input.string())));
  }
  const TreeTrial trial = Enacted(scenario, plan.tree, request);
  const PlannedWorlds* const planned = scenario.interpretation.planned.get();
  const domain::Problem& problem =
      planned == nullptr ? scenario.scenario.problem : planned->worlds[trial.world.world];
  const scene::Scene scene(problem, trial.scene);
  const plan::Plan none;
  ViewedPage page = PageOf({.problem = problem,
                            .plan = planned == nullptr ? none : *planned->PlanOf(trial.world.world),
                            .scene = scene,
                            .trace = trial.trace,
                            .outcome = std::string(trial.OutcomeName()),
                            .reason = trial.reason,
                            .way = WayOf(scenario, plan.tree, trial),
                            .source = fmt::format("trial {} of the plan tree for {}{}",
                                                  trial.number, request.input.string(),
                                                  request.is_every_leaf ? ", leaves in turn" : ""),
                            .plan_file = request.input.string()});
  if (trial.IsFailed()) page.code = ExitCode::kFailed;
  return page;
}

}  // namespace assay::cli
