#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "planner/posting/geometric_relations.h"
#include "planner/posting/objection.h"

namespace assay::posting {

class PartialPlan;

struct PlannerOptions {
  std::int64_t partial_plans = 200'000;     // budget of the first phase
  std::int64_t instance_choices = 100'000;  // budget for making instances, in values tried
  // Asked about each action of the instances as they are made: an instance with one that it objects
  // to is no plan. Empty: no action is objected to.
  Judge judge = {};
  std::int64_t moments = 12'000;  // budget of what the judge works out
  // Asked of each plan instance in turn: the first that it accepts is the plan. Empty: the first.
  std::function<bool(const plan::Plan&)> accept = {};
  // Shown the partial plan, the family that the plan is an instance of; may be empty.
  std::function<void(const PartialPlan&)> show_family = {};
  // Told of every decision as it is taken, one line each, indented by depth; may be empty.
  std::function<void(const std::string&)> trace = {};
};

// Spar's first phase: refines the null plan until no operational or geometric goal is open, then
// takes plan instances until one works (Hutchinson and Kak 1990, "Planning in Spar" and "Goal
// Satisfaction"). Differences from the paper: the depth-first search is repeated with a growing
// limit on the number of actions (Korf 1985), from a lower bound on, so that a shortest plan comes
// first; and where no instance works, or passes the judge, because parts that nobody has moved are
// in the way, that they be moved becomes a goal.
//
// With a judge, plans of more actions are looked for only as long as parts are in the way, or there
// is nothing yet to judge; then, or when moments are spent, the outcome is kBudget: what a judge
// objects to proves nothing. The moments are shared out among the limits on the number of actions.
plan::PlanResult MakePlan(const domain::Problem& problem, const PlannerOptions& options);
// Several searches of one problem share its geometric relations, which this is given.
plan::PlanResult MakePlan(const domain::Problem& problem, const GeometricRelations& relations,
                          const PlannerOptions& options);

}  // namespace assay::posting
