#include "planner/budget/budget.h"

#include <array>

#include "planner/base/check.h"

namespace assay::budget {
namespace {

// Computes the parts of a budget for one plan.
class Multiples {
 public:
  Multiples(const domain::Problem& problem, const plan::Plan& plan)
      : problem_(problem), plan_(plan), quantities_(ErrorQuantitiesOf(problem)) {}

  GreatestMultiple OfPlan() const {
    return FindGreatestMultiple([&](double multiple) { return Obstacle(AllTimes(multiple)); });
  }

  GreatestMultiple OfBestPlan() const {
    return FindGreatestMultiple(
        [&](double multiple) { return PlanAnew(WithErrorsTimes(problem_, multiple)).obstacle; });
  }

  std::vector<OneError> Alone() const {
    std::vector<OneError> alone;
    for (std::size_t i = 0; i < quantities_.size(); ++i) {
      const QuantityGroup one = {quantities_[i].name, {i}};
      alone.push_back({quantities_[i], FindGreatestMultiple([&](double multiple) {
                         return Obstacle(Times({{&one, multiple}}));
                       })});
    }
    return alone;
  }

  Bargain BargainFor(const std::vector<PriceList>& prices) const {
    constexpr int kMostProofs = 2000;
    std::vector<plan::Plan> known = {plan_};
    const auto is_proved = [&](const Purchase& purchase) {
      return IsProved(WithErrorsTimes(problem_, MultiplesOf(prices, purchase, quantities_)), known);
    };
    return {prices, FindCheapestProof(prices, is_proved, kMostProofs)};
  }

  Fronts FrontsOf(const std::vector<QuantityGroup>& groups) const {
    ASSAY_CHECK(groups.size() == 2 || groups.size() == 3, "{} groups", groups.size());
    Fronts fronts = {groups, {}};
    if (groups.size() == 2) {
      fronts.fronts.push_back(FrontWith({}, fronts.groups));
    } else {
      for (const double third : {0.0, 0.5, 1.0, 2.0, 4.0})
        fronts.fronts.push_back(FrontWith(third, fronts.groups));
    }
    return fronts;
  }

 private:
  // The planner may miss a plan for small errors that it finds for greater ones. A plan that is
  // proved for some errors is proved for all smaller ones, so all plans that were found count.
  static bool IsProved(const domain::Problem& problem, std::vector<plan::Plan>& known) {
    for (const plan::Plan& plan : known) {
      if (!ObstacleOfPlan(problem, plan)) return true;
    }
    PlannedAnew planned = PlanAnew(problem);
    if (planned.obstacle) return false;
    known.push_back(std::move(planned.result.plan));
    return true;
  }

  struct Multiplied {
    const QuantityGroup* group;
    double multiple;
  };

  std::vector<double> AllTimes(double multiple) const {
    return std::vector<double>(quantities_.size(), multiple);
  }

  // Returns the multiples of all quantities; those of other groups stay as they are declared.
  std::vector<double> Times(const std::vector<Multiplied>& multiplied) const {
    std::vector<double> multiples = AllTimes(1);
    for (const auto& [group, multiple] : multiplied) {
      for (const std::size_t of : group->quantities) multiples[of] = multiple;
    }
    return multiples;
  }

  std::optional<budget::Obstacle> Obstacle(const std::vector<double>& multiples) const {
    return ObstacleOfPlan(WithErrorsTimes(problem_, multiples), plan_);
  }

  Front FrontWith(std::optional<double> third, const std::vector<QuantityGroup>& groups) const {
    return {third, ParetoFront([&](double first, double second) {
              std::vector<Multiplied> multiplied = {{&groups[0], first}, {&groups[1], second}};
              if (third) multiplied.push_back({&groups[2], *third});
              return Obstacle(Times(multiplied));
            })};
  }

  const domain::Problem& problem_;
  const plan::Plan& plan_;
  std::vector<ErrorQuantity> quantities_;
};

}  // namespace

Budget BudgetOf(const domain::Problem& problem, const plan::Plan& plan,
                const std::vector<PriceList>& prices, const std::vector<QuantityGroup>& groups) {
  const Multiples multiples(problem, plan);
  Budget budget = {multiples.OfPlan(), multiples.OfBestPlan(), multiples.Alone()};
  if (!prices.empty()) budget.bargain = multiples.BargainFor(prices);
  if (!groups.empty()) budget.fronts = multiples.FrontsOf(groups);
  return budget;
}

}  // namespace assay::budget
