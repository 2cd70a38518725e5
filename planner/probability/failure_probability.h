#pragma once

#include <string>
#include <vector>

#include "planner/base/interval.h"
#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "planner/probability/distributed_errors.h"

namespace assay::probability {

// A precondition that may fail, and bounds of the probability that it does.
struct PreconditionFailure {
  plan::StepId step;
  std::string meaning;
  Interval probability;
};

struct FailureProbabilities {
  std::vector<PreconditionFailure> preconditions;  // in the order of execution
  std::vector<Interval> steps;                     // by StepId: that any of its preconditions fails
  Interval plan;                                   // that any precondition fails
};

// Bounds the probability that preconditions of a plan fail. The plan must be executable.
//
// The upper bound is the probability that an error is outside some box, plus the probability that
// preconditions fail which are not proved for this box (Boole's inequality). In the box, an
// expression is a sum of errors plus a rest (first_order_form.h), which may have any value. The
// best of several boxes counts. The lower bound is the probability that one precondition fails
// whatever the rest is, and all errors are inside the box.
//
// A way of the arm or a strategy that is not proved for a box may fail with any probability.
FailureProbabilities FailureProbabilitiesOf(const domain::Problem& problem, const plan::Plan& plan,
                                            const DistributedErrors& errors);

}  // namespace assay::probability
