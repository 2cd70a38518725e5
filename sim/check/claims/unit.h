#pragma once

#include <string_view>

namespace assay::check {

// The unit of a claim's number, kept with it so that no number is taken for one of another unit.
enum class Unit { kNone, kMetre, kRadian };
std::string_view Name(Unit unit);  // "", "m", "rad"

// Returns a length by which values of different units are compared. Radians count as the length of
// an arc at a tenth of a metre from the axis.
double AsLength(double value, Unit unit);

}  // namespace assay::check
