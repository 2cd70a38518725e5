#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/counted.h"
#include "planner/budget/cheapest_proof.h"
#include "planner/budget/error_quantity.h"
#include "planner/budget/greatest_multiple.h"
#include "planner/budget/price_list.h"
#include "planner/plan/plan_files/json_layout.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/stopwatch.h"
#include "sim/cli/command_line/verb.h"
#include "sim/cli/options/models_folder.h"
#include "sim/cli/plan_output/table.h"
#include "sim/cli/tasks/planned_problem.h"

namespace assay::cli {
namespace budget_verb {

using budget::ErrorQuantity;
using budget::GreatestMultiple;
using Json = nlohmann::ordered_json;

struct Options {
  std::filesystem::path input;
  domain::ModelPath models;
  bool json = false;
};

struct OfQuantity {
  ErrorQuantity quantity;
  GreatestMultiple greatest;
};

// The answer to a scenario's prices.
struct Bargain {
  std::vector<budget::PriceList> prices;
  budget::CheapestProof cheapest;
};

struct Budget {
  GreatestMultiple of_plan;       // of all errors, for the plan as it is
  GreatestMultiple of_best_plan;  // of all errors, planned anew
  std::vector<OfQuantity> alone;  // of one quantity, with the others as declared
  std::optional<Bargain> bargain = {};
};

constexpr int kMostProofs = 2000;

// Returns what the scenario's key `prices` offers, or nothing without this key.
std::vector<budget::PriceList> PricesOf(const PlannedProblem& planned) {
  const Document scenario = Document::Load(planned.scenario);
  const std::optional<Value> prices = scenario.root().Find("prices");
  if (!prices) return {};
  return budget::ReadPrices(*prices, domain::ReadUnits(scenario.root()),
                            budget::ErrorQuantitiesOf(planned.problem));
}

Bargain BargainOf(const domain::Problem& problem, const std::vector<budget::PriceList>& prices) {
  const std::vector<ErrorQuantity> quantities = budget::ErrorQuantitiesOf(problem);
  const auto is_proved = [&](const budget::Purchase& purchase) {
    const std::vector<double> multiples = budget::MultiplesOf(prices, purchase, quantities);
    return !budget::PlanAnew(budget::WithErrorsTimes(problem, multiples)).obstacle;
  };
  return {prices, budget::FindCheapestProof(prices, is_proved, kMostProofs)};
}

Budget BudgetOf(const PlannedProblem& planned) {
  const std::vector<budget::PriceList> prices = PricesOf(planned);
  const domain::Problem& problem = planned.problem;
  const plan::Plan& plan = planned.result.plan;
  Budget budget;
  budget.of_plan = budget::FindGreatestMultiple([&](double multiple) {
    return budget::ObstacleOfPlan(budget::WithErrorsTimes(problem, multiple), plan);
  });
  budget.of_best_plan = budget::FindGreatestMultiple([&](double multiple) {
    return budget::PlanAnew(budget::WithErrorsTimes(problem, multiple)).obstacle;
  });
  const std::vector<ErrorQuantity> quantities = budget::ErrorQuantitiesOf(problem);
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    std::vector<double> multiples(quantities.size(), 1);
    budget.alone.push_back({quantities[i], budget::FindGreatestMultiple([&](double multiple) {
                              multiples[i] = multiple;
                              return budget::ObstacleOfPlan(
                                  budget::WithErrorsTimes(problem, multiples), plan);
                            })});
  }
  if (!prices.empty()) budget.bargain = BargainOf(problem, prices);
  return budget;
}

std::string ObstacleText(const GreatestMultiple& greatest) {
  if (!greatest.obstacle) return "";
  const budget::Obstacle& obstacle = *greatest.obstacle;
  return obstacle.step.empty() ? obstacle.meaning
                               : fmt::format("{}: {}", obstacle.step, obstacle.meaning);
}

std::string MultipleText(const GreatestMultiple& greatest) {
  return greatest.unproved ? fmt::format("{:.4g}", greatest.proved)
                           : fmt::format("{:g} or more", greatest.proved);
}

std::string InUsualUnit(const ErrorQuantity& quantity, double amount) {
  return domain::InUnit(amount, domain::ShownUnitOf(quantity.dimension));
}

std::string Text(const Budget& budget) {
  Table all({{"all errors"}, {"multiple", Align::kRight}, {"not proved with 1.01 times it"}});
  all.Add({"the plan as it is", MultipleText(budget.of_plan), ObstacleText(budget.of_plan)});
  all.Add({"the best plan", MultipleText(budget.of_best_plan), ObstacleText(budget.of_best_plan)});
  Table alone({{"one error"},
               {"declared", Align::kRight},
               {"greatest", Align::kRight},
               {"multiple", Align::kRight},
               {"not proved with 1.01 times it"}});
  for (const auto& [quantity, greatest] : budget.alone) {
    alone.Add({quantity.name, InUsualUnit(quantity, quantity.declared),
               InUsualUnit(quantity, greatest.proved * quantity.declared), MultipleText(greatest),
               ObstacleText(greatest)});
  }
  return fmt::format(
      "greatest multiples of the declared errors with which every precondition is proved\n\n{}\n"
      "one error at a time, the others as declared, for the plan as it is\n\n{}",
      all.Text(), alone.Text());
}

std::string Text(const Budget& budget, const Bargain& bargain) {
  const auto& [prices, cheapest] = bargain;
  const std::string tried = fmt::format("{} tried", Counted(cheapest.proofs, "proof"));
  if (!cheapest.purchase) {
    return cheapest.is_exact
               ? fmt::format("not even the best offers prove everything ({})\n", tried)
               : fmt::format("no answer within {}\n", tried);
  }
  Table bought({{"bought"}, {"greatest error", Align::kRight}, {"price", Align::kRight}});
  for (std::size_t i = 0; i < prices.size(); ++i) {
    const budget::Offer& offer = prices[i].offers[(*cheapest.purchase)[i]];
    const ErrorQuantity& quantity = budget.alone[prices[i].quantities.front()].quantity;
    bought.Add(
        {prices[i].name, InUsualUnit(quantity, offer.greatest), fmt::format("{:g}", offer.price)});
  }
  return fmt::format(
      "the cheapest purchase with which every precondition is proved costs {:g} ({})\n\n{}",
      budget::PriceOf(prices, *cheapest.purchase), tried, bought.Text());
}

Json ToJson(const GreatestMultiple& greatest) {
  Json json = {{"proved", greatest.proved}};
  if (greatest.unproved) json["unproved"] = *greatest.unproved;
  if (greatest.obstacle) {
    json["obstacle"] = {{"step", greatest.obstacle->step}, {"meaning", greatest.obstacle->meaning}};
  }
  return json;
}

Json ToJson(const Bargain& bargain) {
  const auto& [prices, cheapest] = bargain;
  Json json = {{"proofs", cheapest.proofs}, {"exact", cheapest.is_exact}};
  if (!cheapest.purchase) return json;
  json["price"] = budget::PriceOf(prices, *cheapest.purchase);
  for (std::size_t i = 0; i < prices.size(); ++i) {
    const budget::Offer& offer = prices[i].offers[(*cheapest.purchase)[i]];
    json["bought"][prices[i].name] = {{"greatest", offer.greatest}, {"price", offer.price}};
  }
  return json;
}

Json ToJson(const Budget& budget) {
  Json json = {{"plan", ToJson(budget.of_plan)}, {"best_plan", ToJson(budget.of_best_plan)}};
  json["quantities"] = Json::array();
  for (const auto& [quantity, greatest] : budget.alone) {
    Json entry = {{"name", quantity.name}, {"declared", quantity.declared}};
    entry.update(ToJson(greatest));
    json["quantities"].push_back(std::move(entry));
  }
  if (budget.bargain) json["cheapest"] = ToJson(*budget.bargain);
  return json;
}

ExitCode Execute(const Options& options) {
  const Stopwatch stopwatch;
  const PlannedProblem planned = ReadOrMakePlan(Document::Load(options.input), options.models);
  RequireSound(planned);
  if (planned.result.outcome != Outcome::kFound) {
    PrintError(fmt::format("{}: there is no plan whose errors could be multiplied",
                           options.input.string()));
    return ExitCodeOf(planned.result.outcome);
  }
  const Budget budget = [&] {
    const Progress progress("multiplying the errors of " + planned.problem.name);
    return BudgetOf(planned);
  }();
  Json json = ToJson(budget);
  json["seconds"] = stopwatch.Seconds();
  std::string text = Text(budget);
  if (budget.bargain) text += "\n" + Text(budget, *budget.bargain);
  Print(options.json ? plan::JsonText(json) : text);
  return ExitCode::kDone;
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("input", options->input, "scenario file, or plan file")->required();
  command.add_flag("--json", options->json, "print the result for programs");
  AddModelsOption(command, options->models);
  return [options] { return Execute(*options); };
}

}  // namespace budget_verb

const Verb kBudget = {
    .name = "budget",
    .summary = "tells how great the errors may be so that everything is proved",
    .page = "sim/budget.md",
    .example = "assay budget scenarios/uncertain-known.yaml",
    .declare = budget_verb::Declare,
};

}  // namespace assay::cli
