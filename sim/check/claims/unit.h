#pragma once

#include <string_view>

namespace assay::check {

// What the number of a claim is, so that none is taken for another.
enum class Unit { kNone, kMetre, kRadian };
std::string_view Name(Unit unit);  // "", "m", "rad"

// To compare what has different units: radians as lengths at a tenth of a metre from the axis.
double AsLength(double value, Unit unit);

}  // namespace assay::check
