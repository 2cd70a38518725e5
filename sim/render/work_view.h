#pragma once

#include <vector>

#include "planner/domain/problem/problem.h"
#include "sim/render/close_up.h"
#include "sim/scene/scene.h"

namespace assay::render {

// Returns balls about the parts and about the hand that is nearest to them, at their present poses.
// There must be at least one part (checked).
std::vector<Ball> WorkOutline(const domain::Problem& problem, const scene::Scene& scene,
                              const std::vector<domain::PartId>& parts, const mujoco::Data& data);

// Returns a camera that shows the parts and the hand nearest to them at their present poses, from
// UsualDirection. There must be at least one part (checked). `aspect` is width over height.
FreeCamera WorkView(const domain::Problem& problem, const scene::Scene& scene,
                    const std::vector<domain::PartId>& parts, const mujoco::Data& data,
                    double aspect);

// Returns the subject of a close-up of a part between the fingers of the acting hand. The corners
// of the part should be visible.
Subject GraspOf(const domain::Problem& problem, const scene::Scene& scene, domain::PartId part,
                const mujoco::Data& data);

}  // namespace assay::render
