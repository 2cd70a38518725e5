#pragma once

#include <optional>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/certificates/condition.h"
#include "planner/plan/data/plan.h"
#include "planner/plan/data/reason.h"

namespace assay::assembly {

// A way of the arm for which kReach or kWayClear of plan::condition is not proved. The way includes
// the straight lines of the work to which it leads.
struct UnprovedWay {
  plan::StepId step;  // the step to whose work the way leads; None: the way home
  plan::Condition condition;
  // What errors may cause. For kWayClear the situation has the two bodies at the posture without
  // errors. It has none if the errors of a part are too great for any proof.
  plan::Reason why;
  // For kWayClear: the greatest share of the tool's pose errors with which the arm surely stays
  // clear, to a hundredth, less than 1. None if the errors of parts alone prevent a proof.
  std::optional<double> share = {};
};

// Returns the unproved ways of a plan in the order of execution. Returns none if the plan claims
// nothing about ways. The plan must have no flaws.
std::vector<UnprovedWay> UnprovedWays(const domain::Problem& problem, const plan::Plan& plan);

}  // namespace assay::assembly
