#pragma once

#include "planner/constraint_posting/uncertainty_phase/augmentation/augmented_steps.h"
#include "planner/constraint_posting/uncertainty_phase/uncertainty_task.h"
#include "planner/plan/data/plan.h"

namespace assay::constraint_posting {

// Returns the plan instance with the inserted actions, certificates, verifications and recoveries.
// `steps` must contain all steps of the instance.
plan::Plan AugmentedPlan(UncertaintyTask& task, const AugmentedSteps& steps,
                         const plan::Plan& instance);

}  // namespace assay::constraint_posting
