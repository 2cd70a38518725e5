#pragma once

#include <string>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::cli {

// Why a step is safe or not, for people, from its certificate alone: what was known before and is
// known after it, what was inserted for it, and the chain of each precondition: the inequality, its
// bound, the worst corner, what each variable costs, and the mildest tightening of a single one
// that would do. What is not proved comes first. Throws InputError, which names `file`, where the
// plan comes from, if an expression of the certificate does not read.
std::string Explanation(const domain::Problem& problem, const plan::Plan& plan, plan::StepId step,
                        const std::string& file);

}  // namespace assay::cli
