#pragma once

#include "planner/uncertainty/uncertain_world.h"

namespace assay::uncertainty {

// The error of a part on the table once the hand has let it go where it thinks is X_WorldPart;
// X_ToolGrasp is T'_d. The displacement's z is that of the part in the hand: landing replaces it.
//
// For a tool that points straight down (or up) the part's rotation is the hand's. A tool that leans
// turns the part about its own axis: the table sets it upright again, which leaves the twist about
// the vertical, and moves the part sideways by at most the tilt times its greatest radius (paper
// mode leaves both out).
RestingError Release(UncertainWorld& world, PartId part, const plan::Hold& hold,
                     const Transform& X_ToolGrasp, const ManipulatorError& draw,
                     const Pose& X_WorldPart);

}  // namespace assay::uncertainty
