#pragma once

#include <vector>

#include "planner/domain/problem/problem.h"
#include "sim/render/close_up.h"
#include "sim/scene/scene.h"

namespace assay::render {

// The parts and the hand that is nearest to them, wherever they are now, from the usual direction.
// At least one part.
FreeCamera WorkView(const domain::Problem& problem, const scene::Scene& scene,
                    const std::vector<domain::PartId>& parts, const mujoco::Data& data,
                    double aspect);

// A part between the fingers of the hand that acts: the part's corners are to be seen.
Subject GraspOf(const domain::Problem& problem, const scene::Scene& scene, domain::PartId part,
                const mujoco::Data& data);

}  // namespace assay::render
