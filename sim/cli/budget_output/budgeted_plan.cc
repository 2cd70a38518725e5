#include "sim/cli/budget_output/budgeted_plan.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>

#include "planner/base/counted.h"
#include "planner/probability/distributed_errors.h"
#include "sim/cli/budget_output/budget_report.h"
#include "sim/cli/budget_output/probability_report.h"
#include "sim/cli/command_line/usage_error.h"

namespace assay::cli {
namespace {

// What the scenario says of smaller errors, and of the probabilities of errors.
struct BudgetKeys {
  std::vector<budget::PriceList> prices;
  std::optional<probability::DistributedErrors> errors;
};

BudgetKeys KeysOf(const PlannedProblem& planned) {
  const Document scenario = Document::Load(planned.scenario);
  const domain::Units units = domain::ReadUnits(scenario.root());
  BudgetKeys keys;
  if (const auto prices = scenario.root().Find("prices")) {
    keys.prices = budget::ReadPrices(*prices, units, budget::ErrorQuantitiesOf(planned.problem));
  }
  if (const auto distributions = scenario.root().Find("distributions")) {
    keys.errors = {probability::ReadDistributions(*distributions, units, planned.problem), {}};
  }
  if (const auto correlations = scenario.root().Find("correlations")) {
    if (!keys.errors) keys.errors.emplace();
    keys.errors->correlations =
        probability::ReadCorrelations(*correlations, keys.errors->distributions, planned.problem);
  }
  return keys;
}

// Returns the groups of a front.
std::vector<budget::QuantityGroup> GroupsNamed(const std::vector<std::string>& names,
                                               const domain::Problem& problem) {
  if (names.size() == 1 || names.size() > 3) {
    throw UsageError(
        fmt::format("a front has {}; allowed: two or three, such as hand.xy and peg.theta",
                    Counted(names.size(), "error")));
  }
  const auto quantities = budget::ErrorQuantitiesOf(problem);
  std::vector<budget::QuantityGroup> groups;
  std::set<std::size_t> named;
  for (const std::string& name : names) {
    const auto group = budget::FindGroup(name, quantities);
    if (!group) {
      throw UsageError(fmt::format("'{}' is no error of this scenario; allowed: {}", name,
                                   budget::NamesOf(quantities)));
    }
    for (const std::size_t of : group->quantities) {
      if (named.insert(of).second) continue;
      throw UsageError(fmt::format("the front names '{}' twice", quantities[of].name));
    }
    groups.push_back(*group);
  }
  return groups;
}

}  // namespace

BudgetedPlan BudgetOf(const PlannedProblem& planned, const std::vector<std::string>& front) {
  const auto groups = GroupsNamed(front, planned.problem);
  const BudgetKeys keys = KeysOf(planned);
  const plan::Plan& plan = planned.result.plan;
  BudgetedPlan budgeted = {budget::BudgetOf(planned.problem, plan, keys.prices, groups), {}};
  if (keys.errors)
    budgeted.failures = probability::FailureProbabilitiesOf(planned.problem, plan, *keys.errors);
  return budgeted;
}

std::string Text(const BudgetedPlan& budgeted, const plan::Plan& plan) {
  std::string text = Text(budgeted.budget);
  if (budgeted.failures) text += "\n" + Text(*budgeted.failures, plan);
  return text;
}

nlohmann::ordered_json ToJson(const BudgetedPlan& budgeted, const plan::Plan& plan) {
  nlohmann::ordered_json json = ToJson(budgeted.budget);
  if (budgeted.failures) json["failures"] = ToJson(*budgeted.failures, plan);
  return json;
}

}  // namespace assay::cli
