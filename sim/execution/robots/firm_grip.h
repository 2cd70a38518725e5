#pragma once

#include "sim/scene/scene.h"

namespace assay::execution {

// Returns whether the pads of the acting hand hold the part firmly: friction could bear twice the
// force and the torque that it bears now, and the pressure on each pad has its centre well within
// the area that touches. The forces of the contacts must be valid (mujoco::Contact).
bool IsFirm(const scene::Scene& scene, const mujoco::Data& data, domain::PartId part);

}  // namespace assay::execution
