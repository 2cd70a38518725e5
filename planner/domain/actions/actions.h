#pragma once

#include <span>

#include "planner/domain/actions/action_template.h"

namespace assay::domain {

extern const ActionRule kPickupRule;
extern const ActionRule kPutdownRule;
extern const ActionRule kAssembleRule;

// All actions that the planner may put into a plan.
std::span<const ActionRule> ActionRules();

}  // namespace assay::domain
