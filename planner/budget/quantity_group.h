#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "planner/budget/error_quantity.h"

namespace assay::budget {

// Errors that vary in step: one quantity, or several coordinates of one part, hand or sensor.
struct QuantityGroup {
  std::string name;                     // "hand.theta", "overhead-camera.xy"
  std::vector<std::size_t> quantities;  // indices in ErrorQuantitiesOf; at least one
};

// Returns the group with this name. The letters x, y and z after the dot may be combined:
// "camera.xy" is camera.x and camera.y. None: one of them is no quantity of the problem.
std::optional<QuantityGroup> FindGroup(const std::string& name,
                                       const std::vector<ErrorQuantity>& quantities);

// Returns the names of all quantities, for messages about names that are none of them.
std::string NamesOf(const std::vector<ErrorQuantity>& quantities);

}  // namespace assay::budget
