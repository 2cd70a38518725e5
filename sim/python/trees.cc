#include "sim/python/trees.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "planner/base/input_files/quotation.h"
#include "planner/base/stop.h"
#include "planner/contingent/tree_check/tree_check.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/shown_executions/tree_lines.h"
#include "sim/cli/shown_executions/tree_trial_execution.h"
#include "sim/cli/tree_output/dot.h"
#include "sim/cli/tree_output/plan_tree_report.h"
#include "sim/cli/tree_output/tree_trial_report.h"
#include "sim/execution/interpretation/planned_worlds.h"
#include "sim/execution/trial/scheduler.h"
#include "sim/python/refused.h"
#include "sim/scenario/models_folder.h"

namespace assay::python {
namespace {

using Json = nlohmann::ordered_json;
using execution::KnowledgeScenario;
using execution::PlannedWorlds;

void RequireNoneOfAssemblies(const PlanSettings& settings) {
  if (!settings.resolvers && settings.propagation == PlanSettings().propagation) return;
  throw cli::UsageError(fmt::format(
      "the goal of {} is about knowledge; resolvers and propagation are for goals of assembly",
      Quote(settings.scenario.string())));
}

Json TreeToJson(const cli::ContingentAnswer& answer, const PlannedWorlds* planned) {
  if (planned != nullptr) return cli::ToJson(planned->worlds, planned->assembly);
  Json json = Json::parse(cli::JsonText(answer));
  json.erase("seconds");
  return json;
}

std::string TreeText(const cli::ContingentAnswer& answer, const PlannedWorlds* planned,
                     std::int64_t budget) {
  return planned != nullptr ? cli::Text(planned->worlds, planned->assembly)
                            : cli::Text(answer, false, budget);
}

// Returns the words with which people read the actions of an assembly's tree, whose names are made
// by the program. The actions of other trees have readable names already.
std::map<std::string, std::string> WordsIn(const KnowledgeScenario& scenario) {
  const PlannedWorlds* const planned = scenario.interpretation.planned.get();
  if (planned == nullptr) return {};
  return cli::ActionWords(planned->worlds, planned->assembly);
}

std::vector<std::shared_ptr<const PlanHandle>> PlansOf(const KnowledgeScenario& scenario,
                                                       const std::string& file) {
  std::vector<std::shared_ptr<const PlanHandle>> handles;
  const PlannedWorlds* const planned = scenario.interpretation.planned.get();
  if (planned == nullptr) return handles;
  for (const auto& [worlds, plan] : planned->assembly.plans) {
    cli::PlannedProblem of_world{
        file, planned->worlds[worlds.front()], scenario.scenario.simulation, {}};
    of_world.result.outcome = Outcome::kFound;
    of_world.result.plan = plan;
    handles.push_back(PlanHandle::OfWorld(std::move(of_world)));
  }
  return handles;
}

bool IsStopped() { return stop_requested; }

}  // namespace

TreeHandle::TreeHandle(KnowledgeScenario scenario, std::string file, std::int64_t budget)
    : scenario_(std::move(scenario)),
      file_(std::move(file)),
      budget_(budget),
      answer_(cli::TreeOf(scenario_.interpretation, budget)),
      plans_(PlansOf(scenario_, file_)) {}

std::shared_ptr<const TreeHandle> TreeHandle::Make(const PlanSettings& settings) {
  RequireSettings(settings);
  const Document document = LoadScenario(settings);
  if (document.root().Find("knowledge")) RequireNoneOfAssemblies(settings);
  const domain::ModelPath models =
      scenario::FindModels(settings.scenario, ModelPathOf(settings.models));
  std::shared_ptr<const TreeHandle> made(
      new TreeHandle(execution::Read(document, models, WorldPlanningFrom(settings)),
                     settings.scenario.string(), settings.budget.value_or(cli::kKnowledgeStates)));
  const Outcome outcome = made->answer_.plan.outcome;
  if (outcome != Outcome::kFound) {
    throw Refused{cli::ExitCodeOf(outcome), made->Text(),
                  std::make_shared<const Json>(made->ToJson())};
  }
  return made;
}

Json TreeHandle::ToJson() const {
  return TreeToJson(answer_, scenario_.interpretation.planned.get());
}

std::string TreeHandle::Text() const {
  return TreeText(answer_, scenario_.interpretation.planned.get(), budget_);
}

std::string TreeHandle::Dot() const { return cli::PlanTreeToDot(answer_.task, tree()); }

Json TreeHandle::Lines() const {
  Json lines = Json::array();
  for (const view::TreeLine& line : cli::TreeLines(answer_.task, tree(), {}, WordsIn(scenario_))) {
    lines.push_back({{"depth", line.depth},
                     {"kind", line.is_action                    ? "action"
                              : line.text.starts_with("go to ") ? "go to"
                                                                : "branch"},
                     {"text", line.text}});
  }
  return lines;
}

Json TreeHandle::Checked(std::int64_t worlds) const {
  const contingent::TreeCheck check =
      contingent::CheckTree(answer_.task, tree(), {.worlds = worlds});
  return {{"holds", check.holds}, {"failure", check.failure}, {"text", cli::Text(check)}};
}

TreeTrials::TreeTrials(std::shared_ptr<const TreeHandle> tree, const TreeTrialSettings& settings)
    : tree_(std::move(tree)),
      settings_(settings),
      seed_(settings.seed.value_or(tree_->scenario().scenario.simulation.seed)),
      worlds_(tree_->scenario(), tree_->tree(), seed_, settings.is_every_leaf) {}

int TreeTrials::usual_count() const {
  return std::max(1, static_cast<int>(worlds_.reachable_count()));
}

execution::TreeTrial TreeTrials::One(int number, double sample_rate) const {
  return execution::RunTrial(
      tree_->scenario(), tree_->tree(), {number, worlds_.WorldOf(number)},
      {.seed = seed_, .sensing_errors = settings_.sensing_errors, .sample_rate = sample_rate});
}

Json TreeTrials::Run(int count, int jobs) const {
  cli::TreeStudy study{.command = {.input = tree_->file(),
                                   .sensing_errors = settings_.sensing_errors,
                                   .seed = seed_},
                       .can_spill = tree_->scenario().interpretation.spill.has_value(),
                       .leaves = worlds_.leaves(),
                       .unreachable = worlds_.unreachable(),
                       .words = WordsIn(tree_->scenario())};
  execution::Scheduler(jobs, IsStopped)
      .InOrder(
          static_cast<std::size_t>(count),
          [this](std::size_t i) { return One(static_cast<int>(i) + 1, 0); },
          [&](std::size_t, execution::TreeTrial trial) {
            study.trials.push_back(std::move(trial));
          });
  Json json = cli::ToJson(study);
  for (const char* key : {"seconds", "replay", "scenario"}) json.erase(key);
  return json;
}

std::shared_ptr<const TracedTrial> TreeTrials::Traced(int number) const {
  return std::make_shared<const TracedTrial>(cli::TreeTrialExecution(
      tree_->scenario(), tree_->tree(), One(number, execution::ExecutorOptions().sample_rate),
      fmt::format("trial {} of the plan tree for {}", number, tree_->file()), tree_->file()));
}

}  // namespace assay::python
