#include "sim/cli/budget_output/budget_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "planner/base/check.h"
#include "planner/base/counted.h"
#include "sim/cli/plan_output/table.h"

namespace assay::cli {
namespace {

using budget::ErrorQuantity;
using budget::GreatestMultiple;
using Json = nlohmann::ordered_json;

std::string ObstacleText(const std::optional<budget::Obstacle>& obstacle) {
  if (!obstacle) return "";
  return obstacle->step.empty() ? obstacle->meaning
                                : fmt::format("{}: {}", obstacle->step, obstacle->meaning);
}

std::string MultipleText(const GreatestMultiple& greatest) {
  return greatest.unproved ? fmt::format("{:.4g}", greatest.proved)
                           : fmt::format("{:g} or more", greatest.proved);
}

std::string InUsualUnit(const ErrorQuantity& quantity, double amount) {
  return domain::InUnit(amount, domain::ShownUnitOf(quantity.dimension));
}

std::string GreatestText(const budget::Budget& budget) {
  Table all({{"all errors"}, {"multiple", Align::kRight}, {"not proved with 1.01 times it"}});
  const auto add = [&](const std::string& what, const GreatestMultiple& greatest) {
    all.Add({what, MultipleText(greatest), ObstacleText(greatest.obstacle)});
  };
  add("the plan as it is", budget.of_plan);
  add("the best plan", budget.of_best_plan);
  Table alone({{"one error"},
               {"declared", Align::kRight},
               {"greatest", Align::kRight},
               {"multiple", Align::kRight},
               {"not proved with 1.01 times it"}});
  for (const auto& [quantity, greatest] : budget.alone) {
    alone.Add({quantity.name, InUsualUnit(quantity, quantity.declared()),
               InUsualUnit(quantity, greatest.proved * quantity.declared()), MultipleText(greatest),
               ObstacleText(greatest.obstacle)});
  }
  return fmt::format(
      "greatest multiples of the declared errors with which every precondition is proved\n\n{}\n"
      "one error at a time, the others as declared, for the plan as it is\n\n{}",
      all.Text(), alone.Text());
}

std::string Text(const budget::Budget& budget, const budget::Bargain& bargain) {
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
    const ErrorQuantity& quantity = budget.alone[prices[i].group.quantities.front()].quantity;
    bought.Add({prices[i].group.name, InUsualUnit(quantity, offer.greatest),
                fmt::format("{:g}", offer.price)});
  }
  return fmt::format(
      "the cheapest purchase with which every precondition is proved costs {:g} ({})\n\n{}",
      budget::PriceOf(prices, *cheapest.purchase), tried, bought.Text());
}

// Returns the quantity of a group that has the greatest declared error. A multiple of the group is
// shown as this quantity's error.
const ErrorQuantity& GreatestOf(const budget::Budget& budget, const budget::QuantityGroup& group) {
  const std::size_t greatest = std::ranges::max(
      group.quantities, {}, [&](std::size_t of) { return budget.alone[of].quantity.declared(); });
  return budget.alone[greatest].quantity;
}

std::string MultipleOf(const budget::Budget& budget, const budget::QuantityGroup& group,
                       double multiple) {
  const ErrorQuantity& quantity = GreatestOf(budget, group);
  return InUsualUnit(quantity, multiple * quantity.declared());
}

std::string Text(const budget::Budget& budget, const budget::Fronts& fronts) {
  const auto& groups = fronts.groups;
  std::string text;
  for (const budget::Front& front : fronts.fronts) {
    text += fmt::format("errors with which every precondition of the plan as it is is proved{}\n\n",
                        front.third ? fmt::format(", with {} of {}", groups[2].name,
                                                  MultipleOf(budget, groups[2], *front.third))
                                    : "");
    Table table({{groups[0].name, Align::kRight},
                 {groups[1].name, Align::kRight},
                 {"not proved with 1.01 times both"}});
    for (const budget::FrontPoint& point : front.points) {
      table.Add({MultipleOf(budget, groups[0], point.proved[0]),
                 MultipleOf(budget, groups[1], point.proved[1]), ObstacleText(point.obstacle)});
    }
    text += table.Text() + "\n";
  }
  return text;
}

void AddObstacle(Json& json, const std::optional<budget::Obstacle>& obstacle) {
  if (obstacle) json["obstacle"] = {{"step", obstacle->step}, {"meaning", obstacle->meaning}};
}

Json ToJson(const GreatestMultiple& greatest) {
  Json json = {{"proved", greatest.proved}};
  if (greatest.unproved) json["unproved"] = *greatest.unproved;
  AddObstacle(json, greatest.obstacle);
  return json;
}

Json ToJson(const budget::Bargain& bargain) {
  const auto& [prices, cheapest] = bargain;
  Json json = {{"proofs", cheapest.proofs}, {"exact", cheapest.is_exact}};
  if (!cheapest.purchase) return json;
  json["price"] = budget::PriceOf(prices, *cheapest.purchase);
  for (std::size_t i = 0; i < prices.size(); ++i) {
    const budget::Offer& offer = prices[i].offers[(*cheapest.purchase)[i]];
    json["bought"][prices[i].group.name] = {{"greatest", offer.greatest}, {"price", offer.price}};
  }
  return json;
}

Json ToJson(const budget::Fronts& fronts) {
  Json json = {{"groups", Json::array()}, {"fronts", Json::array()}};
  for (const budget::QuantityGroup& group : fronts.groups) json["groups"].push_back(group.name);
  for (const auto& [third, points] : fronts.fronts) {
    Json front = Json::object();
    if (third) front["third"] = *third;
    for (const budget::FrontPoint& point : points) {
      Json entry = {{"proved", point.proved}};
      if (point.unproved) entry["unproved"] = *point.unproved;
      AddObstacle(entry, point.obstacle);
      front["points"].push_back(std::move(entry));
    }
    json["fronts"].push_back(std::move(front));
  }
  return json;
}

}  // namespace

std::string Text(const budget::Budget& budget) {
  std::string text = GreatestText(budget);
  if (budget.bargain) text += "\n" + Text(budget, *budget.bargain);
  if (budget.fronts) text += "\n" + Text(budget, *budget.fronts);
  return text;
}

Json ToJson(const budget::Budget& budget) {
  Json json = {{"plan", ToJson(budget.of_plan)}, {"best_plan", ToJson(budget.of_best_plan)}};
  json["quantities"] = Json::array();
  for (const auto& [quantity, greatest] : budget.alone) {
    Json entry = {{"name", quantity.name}, {"declared", quantity.declared()}};
    entry.update(ToJson(greatest));
    json["quantities"].push_back(std::move(entry));
  }
  if (budget.bargain) json["cheapest"] = ToJson(*budget.bargain);
  if (budget.fronts) json["pareto"] = ToJson(*budget.fronts);
  return json;
}

report::FrontPicture FrontPictureOf(const budget::Budget& budget) {
  ASSAY_CHECK(budget.fronts.has_value(), "a budget without fronts");
  const auto& [groups, fronts] = *budget.fronts;
  report::FrontPicture picture;
  std::array<double, 2> scale = {};
  for (std::size_t i = 0; i < 2; ++i) {
    const ErrorQuantity& quantity = GreatestOf(budget, groups[i]);
    const domain::Unit unit = domain::ShownUnitOf(quantity.dimension);
    scale[i] = quantity.declared() / unit.factor;
    picture.axes[i] =
        unit.name.empty() ? groups[i].name : fmt::format("{}, {}", groups[i].name, unit.name);
  }
  picture.declared = scale;
  const auto shown = [&](const std::array<double, 2>& multiples) {
    return std::array{multiples[0] * scale[0], multiples[1] * scale[1]};
  };
  for (const auto& [third, points] : fronts) {
    report::FrontCurve curve;
    if (third) {
      curve.label = fmt::format("{} {}", groups[2].name, MultipleOf(budget, groups[2], *third));
    }
    for (const budget::FrontPoint& point : points) {
      curve.proved.push_back(shown(point.proved));
      if (point.unproved) curve.unproved.push_back(shown(*point.unproved));
    }
    picture.curves.push_back(std::move(curve));
  }
  return picture;
}

}  // namespace assay::cli
