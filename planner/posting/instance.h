#pragma once

#include <functional>
#include <vector>

#include "planner/base/budget.h"
#include "planner/plan/data/plan.h"
#include "planner/posting/objection.h"
#include "planner/posting/partial_plan.h"
#include "planner/posting/step_geometry.h"

namespace assay::posting {

// The values of one step's own plan variables, and where its part rests.
struct StepValues {
  int grasp = -1;                                       // of the part that the hand takes or has
  int position = -1;                                    // label
  domain::Pose X_WorldPart = domain::Pose::Identity();  // pickup: where it rests; putdown: where it
                                                        // will; assemble: where the fixed part does
};

// A consistent value for every plan variable, down to places on the table.
struct PlanInstance {
  std::vector<StepId> order = {};       // of execution, without start and finish
  std::vector<StepValues> values = {};  // by step index
};

// Goes through the plan instances of a partial plan: labels that satisfy the constraint network,
// and for each putdown a place on the table, such that every step works among the parts as they
// then lie. The network knows stable poses only; here poses are whole, so this is also where the
// parts' being in each other's way shows (the paper leaves that out).
//
// Depth-first over the steps in the order of execution, one choice a step: the grasp of a pickup,
// the position of a putdown. When a step has no value, the search goes back to the latest choice
// that took part in ruling values out (conflict-directed backjumping, Prosser 1993). A value that
// the judge objects to is ruled out by the choices that the objection speaks of.
class InstanceSearch {
 public:
  // What a search may spend: values tried, and moments that the judge works out.
  struct Budgets {
    Budget& values;
    Budget& moments;
    bool Exhausted() const { return values.Exhausted() || moments.Exhausted(); }
  };

  // `judge` is asked about each step as its value is chosen; empty: there is no objection.
  InstanceSearch(const PartialPlan& plan, const Judge& judge, Budgets budgets);

  // Hands the instances to `accept` one after another, as they are found, until it answers true:
  // then so does this. Each combination of labels comes once, with the first places that work.
  bool Find(const std::function<bool(const PlanInstance&)>& accept);

  // Parts that stood in the way of some step with some values.
  const Blockers& blockers() const { return blockers_; }
  bool met_objections() const { return met_objections_; }

 private:
  const PartialPlan& plan_;
  const Judge& judge_;
  Budgets budgets_;
  Blockers blockers_;
  bool met_objections_ = false;
};

// Whether the instance's values also work in another order of its steps.
bool WorksInOrder(const PartialPlan& plan, const PlanInstance& instance,
                  const std::vector<StepId>& order);

// The instance written out. Orders in which its values do not work are excluded by ordering
// constraints of the order of execution. Steps for which a part had to be moved say why.
plan::Plan WriteOut(const PartialPlan& plan, const PlanInstance& instance);

}  // namespace assay::posting
