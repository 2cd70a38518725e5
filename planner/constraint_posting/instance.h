#pragma once

#include <functional>
#include <vector>

#include "planner/base/budget.h"
#include "planner/constraint_posting/objection.h"
#include "planner/constraint_posting/partial_plan.h"
#include "planner/constraint_posting/step_geometry.h"
#include "planner/plan/data/plan.h"

namespace assay::constraint_posting {

// The values of one step's own plan variables, and the pose in which its part rests.
struct StepValues {
  // the grasp with which the hand takes or holds the part
  int grasp = -1;
  int position = -1;  // the position label
  // The pose in which a part rests: the part before a pickup, the part after a putdown, or the
  // fixed part of an assemble.
  domain::Pose X_WorldPart = domain::Pose::Identity();
};

// A consistent value for every plan variable, including places on the table.
struct PlanInstance {
  // the order of execution, without the start and finish steps
  std::vector<StepId> order = {};
  std::vector<StepValues> values = {};  // indexed by step
};

// Searches the plan instances of a partial plan. An instance has labels that satisfy the constraint
// network, and a place on the table for each putdown, such that every step works among the parts as
// they then lie. The network contains stable poses only. Here poses are complete, so parts that
// block each other are found here (the paper leaves that out).
//
// The search is depth-first over the steps in the order of execution. Each step is one choice: the
// grasp of a pickup, or the position of a putdown. When a step has no value, the search goes back
// to the latest choice that helped to rule values out (conflict-directed backjumping, Prosser
// 1993). If the judge objects to a value, the choices that the objection names have ruled it out.
class InstanceSearch {
 public:
  // The budget of a search: `values` counts values tried, and `moments` counts snapshots that the
  // judge computes.
  struct Budgets {
    Budget& values;
    Budget& moments;
    bool Exhausted() const { return values.Exhausted() || moments.Exhausted(); }
  };

  // `judge` is called for each step when its value is chosen. An empty judge never objects.
  InstanceSearch(const PartialPlan& plan, const Judge& judge, Budgets budgets);

  // Passes the instances to `accept` one after another, as they are found. Returns true as soon as
  // `accept` returns true, and false if it never does. Each combination of labels occurs once, with
  // the first places that work.
  bool Find(const std::function<bool(const PlanInstance&)>& accept);

  // Returns the parts that were in the way of some step with some values.
  const Blockers& blockers() const { return blockers_; }
  bool met_objections() const { return met_objections_; }

 private:
  const PartialPlan& plan_;
  const Judge& judge_;
  Budgets budgets_;
  Blockers blockers_;
  bool met_objections_ = false;
};

// Returns true if the instance's values also work in another order of its steps.
bool WorksInOrder(const PartialPlan& plan, const PlanInstance& instance,
                  const std::vector<StepId>& order);

// Returns the instance as a plan. If its values do not work in every order that the partial plan
// allows, ordering constraints fix the order of execution. Steps for which a part had to be moved
// say why.
plan::Plan WriteOut(const PartialPlan& plan, const PlanInstance& instance);

}  // namespace assay::constraint_posting
