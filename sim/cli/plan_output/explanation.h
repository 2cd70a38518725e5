#pragma once

#include <string>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::cli {

// Returns a text for people that explains from a step's certificate alone why the step is safe or
// not. It states what was known before and is known after the step, and what was inserted for it.
// For each precondition it gives the inequality, its bound, the worst corner, the cost of each
// variable, and the mildest tightening of a single variable that would prove it. Preconditions that
// are not proved come first. Throws InputError, which names the plan's `file`, if an expression of
// the certificate cannot be read.
std::string Explanation(const domain::Problem& problem, const plan::Plan& plan, plan::StepId step,
                        const std::string& file);
// Returns what errors may cause on the ways of the arm to the step, and home after the last step,
// if these are not proved; empty if they are. The plan must have no flaws.
std::string UnprovedWaysText(const domain::Problem& problem, const plan::Plan& plan,
                             plan::StepId step);

}  // namespace assay::cli
