#pragma once

#include "planner/base/check.h"
#include "planner/contingent/grounding/grounding.h"
#include "planner/contingent/language/externs.h"
#include "planner/contingent/search/contingent_planner.h"
#include "planner/contingent/tree_check/tree_check.h"

namespace assay::fuzz {

// Grounds the task, plans with a small budget, and checks a found tree in some of its worlds.
inline void GroundAndPlan(const contingent::Domain& domain, const contingent::Problem& problem) {
  contingent::Externs externs;
  const contingent::GroundTask task = contingent::Ground(domain, problem, externs);
  Budget budget(200);
  const contingent::ContingentPlan plan =
      contingent::MakePlan(task, contingent::Wanted::kFirst, budget);
  if (plan.outcome == Outcome::kFound) contingent::CheckTree(task, plan.tree, {.worlds = 20});
}

}  // namespace assay::fuzz
