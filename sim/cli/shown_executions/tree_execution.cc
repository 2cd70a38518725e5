#include <fmt/format.h>

#include "planner/base/input_files/quotation.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/shown_executions/tree_trial_execution.h"
#include "sim/cli/tasks/tree_worlds.h"
#include "sim/scenario/models_folder.h"

namespace assay::cli {
namespace {

using execution::KnowledgeScenario;

execution::TreeTrial Enacted(const KnowledgeScenario& scenario, const contingent::PlanTree& tree,
                             const ShowRequest& request) {
  const Progress progress("executing the plan tree for " + scenario.scenario.problem.name);
  const std::uint64_t seed = scenario.scenario.simulation.seed;
  const int number = request.number.value_or(1);
  const TreeWorlds worlds(scenario, tree, seed, request.is_every_leaf);
  return execution::RunTrial(
      scenario, tree, {number, worlds.WorldOf(number)},
      {.seed = seed, .sample_rate = execution::ExecutorOptions().sample_rate});
}

}  // namespace

ShownExecution TreeExecution(const ShowRequest& request) {
  const KnowledgeScenario scenario =
      execution::Load(request.input, scenario::FindModels(request.input, request.models));
  const contingent::ContingentPlan plan = TreeOf(scenario.interpretation).plan;
  if (plan.outcome != Outcome::kFound) {
    throw UsageError(fmt::format("{}: there is no plan tree for {} (see assay plan)", request.verb,
                                 Quote(request.input.string())));
  }
  return TreeTrialExecution(
      scenario, plan.tree, Enacted(scenario, plan.tree, request),
      fmt::format("trial {} of the plan tree for {}{}", request.number.value_or(1),
                  request.input.string(), request.is_every_leaf ? ", leaves in turn" : ""),
      request.input.string());
}

}  // namespace assay::cli
