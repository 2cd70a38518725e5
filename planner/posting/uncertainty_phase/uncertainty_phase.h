#pragma once

#include <cstdint>

#include "planner/posting/posting_planner.h"
#include "planner/posting/uncertainty_phase/uncertainty_options.h"

namespace assay::posting {

// A plan instance with its certificates, error count, verifications and recoveries (Spar,
// "Satisfying Uncertainty-Reduction Goals").
struct AugmentedPlanInstance {
  plan::Plan plan;
  double violation = 0;  // metres and radians: how far unproved bounds are beyond their limits
  std::int64_t combinations = 0;  // tried
};

// Goes through the instance in the order of execution. For each action: certify its preconditions;
// if one is not proved, look for the fewest remedies, sensing first, that prove all of them and
// keep what is proved; else insert what brings the step nearest without moving parts, count an
// error and add the workcell's verification and recovery templates. Beyond the paper, remedies go
// in wherever their preconditions hold, not only right before the step, and a remedy may prepare
// another's own goals: sensing before squeezing, for this part or for another.
AugmentedPlanInstance Augment(const domain::Problem& problem, const plan::Plan& instance,
                              const UncertaintyOptions& options);

// Both phases: plan instances of the first phase are augmented one after another until one has no
// errors; else the one with the fewest, among these the fewest actions of the first phase, and then
// the smallest violation. Beyond the paper, the first phase is asked for further plans, not only
// for further instances of one. Instances that surely have errors, whatever the remedies, wait for
// the others; those of them that could still come first are augmented, the most promising first,
// but not all that could by their violation alone.
//
// Then, unless no instance can have fewer errors than the best, the first phase searches for a plan
// with none, with one, and so on, and this phase judges each action as it is chosen (objection.h):
// what cannot be proved leads to another grasp, place or order, or becomes the goal that a part be
// moved out of the way. This is what the paper's two phases cannot do ("Satisfying
// Uncertainty-Reduction Goals", on a part among others). planner.accept and planner.judge must be
// empty.
plan::PlanResult MakeCertifiedPlan(const domain::Problem& problem, const PlannerOptions& planner,
                                   const UncertaintyOptions& options);

}  // namespace assay::posting
