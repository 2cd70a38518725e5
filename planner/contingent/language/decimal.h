#pragma once

#include <optional>

#include "planner/base/interval.h"

namespace assay::contingent {

// Numbers of task files are decimals: of at most nine places and up to a million, a double stands
// for the decimal that reads as it, and sums of such are exact. So 0.1 + 0.2 is 0.3.

// None where that cannot be told: of longer and larger ones.
std::optional<double> ExactSum(double a, double b);
// Rounded where it cannot be told.
inline double NearestSum(double a, double b) { return ExactSum(a, b).value_or(a + b); }
// Encloses the sums; its ends are exact where they can be told.
Interval EnclosingSum(const Interval& a, const Interval& b);
// From the low to the high end, not less than that.
double WidthOf(double low, double high);

}  // namespace assay::contingent
