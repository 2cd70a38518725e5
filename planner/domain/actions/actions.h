#pragma once

#include "planner/domain/actions/action_template.h"

namespace assay::domain {

extern const ActionRule kPickupRule;
extern const ActionRule kPutdownRule;
extern const ActionRule kAssembleRule;

}  // namespace assay::domain
