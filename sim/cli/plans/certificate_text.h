#pragma once

#include <string>

#include "planner/plan/data/plan.h"

namespace assay::cli {

// For people.

// "12 proved", "11 of 12 proved", "10 of 12 proved, 2 absorbed"; nothing if the step has no
// preconditions.
std::string CertificateText(const plan::PlannedStep& step);

// What was inserted for which step and why, what could not be proved, and what stands by for it.
// Empty if the plan was made without regard to uncertainty.
std::string UncertaintyText(const plan::Plan& plan);
// What may fail though every precondition is proved (plan::NotCovered), a line each.
std::string NotCoveredText(const plan::Plan& plan);

// "steps 2, 4": by their places in the order of execution.
std::string StepsText(const plan::Plan& plan, const std::vector<plan::StepId>& steps);

// What was inserted for the step and why, the strategy that it is executed by, and the checks after
// it with what is done about each error. Empty if nothing was.
std::string ResolutionsText(const plan::Plan& plan, plan::StepId step);

}  // namespace assay::cli
