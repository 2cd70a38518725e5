#pragma once

#include <optional>

#include "planner/base/interval.h"

namespace assay::contingent {

// Numbers in PKS and PDDL files are decimals. A decimal of at most nine places and of at most a
// million is represented by the double that reads as it, and its sums are exact: 0.1 + 0.2 is 0.3.

// Returns the exact sum of two decimals of such files. Returns none for numbers that have more
// places or are larger.
std::optional<double> ExactSum(double a, double b);
// Returns the exact sum of two decimals of such files where it is known, and the rounded sum
// elsewhere.
inline double NearestSum(double a, double b) { return ExactSum(a, b).value_or(a + b); }
// Returns an interval that contains every sum of a decimal of `a` and a decimal of `b`. Its ends
// are exact where the exact sums are known.
Interval EnclosingSum(const Interval& a, const Interval& b);
// Returns the distance from the decimal `low` to the decimal `high`, or a slightly greater number
// where rounding is possible.
double WidthOf(double low, double high);

}  // namespace assay::contingent
