#pragma once

#include <functional>

#include "planner/base/budget.h"
#include "planner/constraint_posting/objection.h"
#include "planner/constraint_posting/partial_plan.h"
#include "planner/constraint_posting/plan_instance.h"
#include "planner/constraint_posting/step_geometry.h"

namespace assay::constraint_posting {

// Searches the plan instances of a partial plan. An instance has labels that satisfy the constraint
// network, and a place on the table wherever an action leaves a part, such that every step works
// among the parts as they then lie. The network contains stable poses only. Here poses are
// complete, so parts that block each other are found here (the paper leaves that out).
//
// The search is depth-first over the steps in the order of execution. Each step is one choice: the
// grasp or the position of which its action is the producer. When a step has no value, the search
// goes back to the latest choice that helped to rule values out (conflict-directed backjumping,
// Prosser 1993). If the judge objects to a value, the choices that the objection names have ruled
// it out.
class InstanceSearch {
 public:
  // The budget of a search: `values` counts values tried, and `snapshots` counts snapshots that the
  // judge computes.
  struct Budgets {
    Budget& values;
    Budget& snapshots;
    bool Exhausted() const { return values.Exhausted() || snapshots.Exhausted(); }
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

}  // namespace assay::constraint_posting
