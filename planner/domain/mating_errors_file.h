#pragma once

#include "planner/base/document.h"
#include "planner/domain/mating_errors.h"
#include "planner/domain/units.h"

namespace assay::domain {

inline constexpr Range kMatingDisplacements = {0, 0.02};                     // metres
inline constexpr Range kMatingRotations = {0, 10 * std::numbers::pi / 180};  // radians

// `{displacement: , rotation: }`; what is left out is as usual. Throws InputError.
MatingErrors ReadMatingErrors(const Value& map, const Units& units);

}  // namespace assay::domain
