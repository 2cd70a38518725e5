#pragma once

#include "planner/plan/data/tool_error_box.h"
#include "planner/uncertainty/error_sets/uncertain_world.h"

namespace assay::uncertainty {

// Returns the error box of a tool pose. With a part `guide`, the tool pose follows the part: the
// hand goes to where the part is believed to be at that time, with the hand's own error. Without a
// guide (None), the hand goes to the planned pose, with its own error.
plan::ToolErrorBox ToolErrorBoxAt(const UncertainWorld& world, PartId guide,
                                  const Pose& X_WorldTool);

}  // namespace assay::uncertainty
