#pragma once

#include "planner/base/input_files/document.h"
#include "planner/domain/matings/mating_errors.h"
#include "planner/domain/units/units.h"

namespace assay::domain {

inline constexpr Range kMatingDisplacements = {0, 0.02};                     // metres
inline constexpr Range kMatingRotations = {0, 10 * std::numbers::pi / 180};  // radians
inline constexpr Range kMatingVelocities = {0, 0.1};                         // shares

// Reads `{displacement: , rotation: , velocity: }`. Missing keys keep the defaults of MatingErrors.
// Throws InputError.
MatingErrors ReadMatingErrors(const Value& map, const Units& units);

}  // namespace assay::domain
