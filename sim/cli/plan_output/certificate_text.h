#pragma once

#include <string>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::cli {

// These functions return text for people.

// Returns how many preconditions are proved: "12 proved", "11 of 12 proved", "10 of 12 proved, 2
// absorbed". Empty if the step has no preconditions.
std::string CertificateText(const plan::PlannedStep& step);

// Returns which steps were inserted for which step and why, what could not be proved, and which
// recoveries the plan has for it. Empty if the plan was made without regard to uncertainty.
std::string UncertaintyText(const domain::Problem& problem, const plan::Plan& plan);
// Returns what may fail although every precondition is proved (plan::NotCovered), with a line for
// each.
std::string NotCoveredText(const domain::Problem& problem, const plan::Plan& plan);

// Returns the steps by their places in the order of execution: "steps 2, 4".
std::string StepsText(const plan::Plan& plan, const std::vector<plan::StepId>& steps);

// Returns the steps that were inserted for a step and why, the strategy that executes it, and its
// verifications with the recovery from each error. Empty if there is none of these.
std::string ResolutionsText(const plan::Plan& plan, plan::StepId step);

}  // namespace assay::cli
