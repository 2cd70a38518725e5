#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "planner/base/interval.h"
#include "planner/domain/units/units.h"

namespace assay::report {

// These functions write numbers on pages. The minus sign is U+2212, commas separate thousands, and
// an en dash stands for a value that is not a number.

// Writes a number of things, like "20,000".
std::string CountText(std::int64_t count);
// Writes a count with its noun: "1 trial" or "2 trials" if `what` is "trial".
std::string CountText(std::int64_t count, std::string_view what);

// Writes a number with `digits` significant digits: "0.136", "1,230", "2.1 × 10⁻⁷", "∞".
std::string NumberText(double value, int digits = 3);

// Converts a number in SI units to the unit in which pages show it.
double Shown(double value, domain::Dimension dimension);

// Writes a number with its unit, like "0.136 mm" or "−0.31°".
std::string QuantityText(double value, domain::Dimension dimension);
// Writes an interval: "±0.136 mm", "−0.2 to 0.31 mm", "≥ 0 mm", or "0.1 mm" if both ends are the
// same.
std::string IntervalText(const Interval& interval, domain::Dimension dimension);

// Writes a rate, like "98.1 %". It is 0 or 100 only if none or all of the trials succeeded.
std::string RateText(int successes, int trials);
// Writes Wilson's 95 % interval of a rate, like "97.1 to 98.8 %".
std::string WilsonText(int successes, int trials);

// Writes a number of seconds in a readable unit, like "2 min".
std::string DurationText(double seconds);

}  // namespace assay::report
