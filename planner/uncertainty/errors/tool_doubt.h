#pragma once

#include "planner/plan/data/tool_doubt.h"
#include "planner/uncertainty/errors/uncertain_world.h"

namespace assay::uncertainty {

// Of a pose of the tool that goes with the part `guide`: the hand goes where the part is believed
// to be by then, and errs. None: it goes where the plan has it, and errs.
plan::ToolDoubt ToolDoubtAt(const UncertainWorld& world, PartId guide, const Pose& X_WorldTool);

}  // namespace assay::uncertainty
