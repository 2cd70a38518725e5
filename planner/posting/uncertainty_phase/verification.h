#pragma once

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::posting {

// Prepares for the failure of a step that could not be proved: adds to the plan what the workcell's
// templates say of checks after such a step, and of recoveries from the errors that they signal
// (Spar, figures 11 and 12). What is measured may lie as far from what is expected as the step's
// certificate says it may when all goes well, and the template's tolerance further; a search is as
// fine as the parts' clearance asks for.
void AddVerification(const domain::Problem& problem, plan::StepId step, const plan::Action& action,
                     const plan::Certificate& certificate, plan::Plan& plan);

}  // namespace assay::posting
