#pragma once

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::constraint_posting {

// Prepares for the failure of a step that could not be proved. It adds to the plan the checks that
// the workcell's templates prescribe after the step, and the recoveries from the errors that these
// checks signal (Spar, figures 11 and 12). The tolerance of a height is the template's tolerance
// plus the deviation that the step's certificate allows without a failure. A recovery that searches
// for the hole moves the shaft in steps so small that, with the clearance of the parts, no step
// passes over the hole.
void AddVerification(const domain::Problem& problem, plan::StepId step, const plan::Action& action,
                     const plan::Certificate& certificate, plan::Plan& plan);

}  // namespace assay::constraint_posting
