#pragma once

#include <cstddef>
#include <vector>

#include "planner/constraint_posting/partial_plan.h"
#include "planner/plan/data/plan.h"

namespace assay::constraint_posting {

// The values of one step's own plan variables, and the pose in which its part rests.
struct StepValues {
  // the grasp with which the hand takes or holds the part
  int grasp = -1;
  int position = -1;  // the position label
  // The pose of the action's place (plan::Action::place). It is the pose of the part before it is
  // taken or after it is put down, or the pose of the fixed part of a mating.
  domain::Pose X_WorldPart = domain::Pose::Identity();
};

// A consistent value for every plan variable, including places on the table.
struct PlanInstance {
  // the order of execution, without the start and finish steps
  std::vector<StepId> order = {};
  std::vector<StepValues> values = {};  // indexed by step
};

// Returns the orders in which the actions of a plan can be executed, at most kMostOrders. With one
// hand there are few orders.
inline constexpr std::size_t kMostOrders = 64;
std::vector<std::vector<StepId>> OrdersOf(const PartialPlan& plan);

// Returns the action of a step with the step's values.
plan::Action WriteAction(const domain::Problem& problem, const domain::ActionTemplate& action,
                         const StepValues& values);

// Returns the instance as a plan. If its values do not work in every order that the partial plan
// allows, ordering constraints fix the order of execution. Steps for which a part had to be moved
// say why.
plan::Plan WriteOut(const PartialPlan& plan, const PlanInstance& instance);

}  // namespace assay::constraint_posting
