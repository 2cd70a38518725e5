#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "planner/constraint_posting/geometric_relations.h"
#include "planner/constraint_posting/objection.h"
#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::constraint_posting {

class PartialPlan;

struct PlannerOptions {
  std::int64_t partial_plans = 200'000;     // budget of the first phase, in partial plans
  std::int64_t instance_choices = 100'000;  // budget for making instances, in values tried
  // Called for each action while an instance is made. If the judge objects to an action, the
  // instance is not a plan. An empty judge never objects.
  Judge judge = {};
  std::int64_t snapshots = 12'000;  // budget of the judge, in computed snapshots
  // Called for each plan instance in turn. The first accepted one is the plan. Without a function,
  // the first instance is the plan.
  std::function<bool(const plan::Plan&)> accept = {};
  // Receives the partial plan of which the plan is an instance; may be empty.
  std::function<void(const PartialPlan&)> show_family = {};
  // Receives every decision as it is taken, one line each, indented by depth; may be empty.
  std::function<void(const std::string&)> trace = {};
};

// Spar's first phase. It refines the null plan until no operational or geometric goal is open, and
// then makes plan instances until one works (Hutchinson and Kak 1990, "Planning in Spar" and "Goal
// Satisfaction"). There are two differences from the paper. The depth-first search is repeated with
// a growing limit on the number of actions (Korf 1985), from a lower bound on, so that a shortest
// plan comes first. If no instance works, or passes the judge, because of parts in the way that no
// step has moved, moving them becomes a goal.
//
// With a judge, plans of more actions are searched for only while parts are in the way, or while
// the judge has not objected. After that, or when the snapshots are spent, the outcome is kBudget,
// because an objection of a judge proves nothing. The snapshots are divided among the limits on the
// number of actions.
plan::PlanResult MakePlan(const domain::Problem& problem, const PlannerOptions& options);
// Plans with the given geometric relations, which several searches of one problem can share.
plan::PlanResult MakePlan(const domain::Problem& problem, const GeometricRelations& relations,
                          const PlannerOptions& options);

}  // namespace assay::constraint_posting
