#pragma once

#include <optional>
#include <vector>

#include "planner/budget/cheapest_proof.h"
#include "planner/budget/error_quantity.h"
#include "planner/budget/greatest_multiple.h"
#include "planner/budget/pareto_front.h"
#include "planner/budget/price_list.h"
#include "planner/budget/quantity_group.h"
#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::budget {

// How great one error may be, with the others as declared.
struct OneError {
  ErrorQuantity quantity;
  GreatestMultiple greatest;
};

// The answer to a scenario's prices.
struct Bargain {
  std::vector<PriceList> prices;
  CheapestProof cheapest;
};

// The front of two groups of errors, with this multiple of the third group if there is one.
struct Front {
  std::optional<double> third = {};
  std::vector<FrontPoint> points;
};

// Two or three groups of errors, and their fronts for the plan as it is.
struct Fronts {
  std::vector<QuantityGroup> groups;
  std::vector<Front> fronts;
};

// The errors that a plan can bear.
struct Budget {
  GreatestMultiple of_plan;       // of all errors, for the plan as it is
  GreatestMultiple of_best_plan;  // of all errors, planned anew
  std::vector<OneError> alone;    // for the plan as it is
  std::optional<Bargain> bargain = {};
  std::optional<Fronts> fronts = {};
};

// Returns the budget of a plan that can be executed. Without prices there is no bargain, and
// without groups there are no fronts. There must be no group, or two or three.
Budget BudgetOf(const domain::Problem& problem, const plan::Plan& plan,
                const std::vector<PriceList>& prices, const std::vector<QuantityGroup>& groups);

}  // namespace assay::budget
