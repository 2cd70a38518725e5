#pragma once

#include "sim/check/noise_floor/noise_floor.h"

namespace assay::check {

// Measures the noise floor by executing the plan twice without noise, once with half the timestep.
NoiseFloor MeasureNoiseFloor(const domain::Problem& problem, const plan::Plan& plan,
                             const scene::SceneOptions& scene);

}  // namespace assay::check
