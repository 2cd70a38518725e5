#pragma once

#include <cstdint>

#include "planner/constraint_posting/posting_planner.h"
#include "planner/constraint_posting/uncertainty_phase/uncertainty_options.h"

namespace assay::constraint_posting {

// A plan instance with its certificates, error count, verifications and recoveries (Spar,
// "Satisfying Uncertainty-Reduction Goals").
struct AugmentedPlanInstance {
  plan::Plan plan;
  // the sum of the excesses of unproved bounds over their limits, in metres and radians
  double violation = 0;
  std::int64_t combinations = 0;  // the number of combinations of remedies tried
};

// Augments an instance, action by action in the order of execution. It certifies the preconditions
// of each action. If a precondition is not proved, it searches for the smallest set of remedies
// that proves all preconditions of the action and keeps the goals that are proved already. It tries
// sensing first. If there is no such set, it inserts the remedies that come nearest to a proof and
// move no part, counts an error for the step, and adds the workcell's verification and recovery
// templates. Beyond the paper, remedies are inserted wherever their preconditions hold, not only
// right before the step. A remedy may serve to prove the goals of another remedy. For example, this
// part or another one may be sensed before it is squeezed.
AugmentedPlanInstance Augment(const domain::Problem& problem, const plan::Plan& instance,
                              const UncertaintyOptions& options);

// Runs both phases. The plan instances of the first phase are augmented one after another until all
// steps of one are proved. If there is none, the result has the fewest unproved steps, then the
// fewest actions of the first phase, and then the smallest violation. Beyond the paper, the first
// phase is asked for further plans, not only for further instances of one plan. An instance that
// surely has unproved steps, whatever the remedies, waits until all instances are known. Then the
// waiting instances that could still become the best are augmented, the most promising first. Some
// instances could become the best only by a smaller violation. Few of these are augmented.
//
// After that, further searches are made if an instance with fewer unproved steps than the best is
// possible. The first phase searches for a plan without unproved steps, then with one, and so on.
// During these searches, this phase judges each action as it is chosen (objection.h). An unproved
// precondition leads to another grasp, place or order, or becomes the goal that a part be moved out
// of the way. The paper's two phases cannot do this ("Satisfying Uncertainty-Reduction Goals", on a
// part among others). planner.accept and planner.judge must be empty.
plan::PlanResult MakeCertifiedPlan(const domain::Problem& problem, const PlannerOptions& planner,
                                   const UncertaintyOptions& options);

}  // namespace assay::constraint_posting
