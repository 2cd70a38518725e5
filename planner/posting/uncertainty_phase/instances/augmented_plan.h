#pragma once

#include "planner/plan/data/plan.h"
#include "planner/posting/uncertainty_phase/instances/augmented_steps.h"
#include "planner/posting/uncertainty_phase/uncertainty_task.h"

namespace assay::posting {

// The plan instance with what was inserted, and with certificates, verifications and recoveries.
// `steps` are all that the instance has.
plan::Plan AugmentedPlan(UncertaintyTask& task, const AugmentedSteps& steps,
                         const plan::Plan& instance);

}  // namespace assay::posting
