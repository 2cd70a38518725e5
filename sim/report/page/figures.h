#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "planner/base/interval.h"

namespace assay::report {

// Numbers as people read them. The minus is U+2212, thousands are parted by
// commas; what is not a number is an en dash.

std::string CountText(std::int64_t count);  // "20,000"
// "1 trial", "2 trials"
std::string CountText(std::int64_t count, std::string_view what);

// With that many significant digits: "0.136", "1,230", "2.1 × 10⁻⁷", "∞".
std::string NumberText(double value, int digits = 3);

// A value of a claim in the unit in which it is shown: metres as millimetres,
// radians as degrees.
double Shown(double value, std::string_view unit);
std::string_view ShownUnit(std::string_view unit);  // "mm", "°"; empty for what has none

// "0.136 mm", "−0.31°".
std::string QuantityText(double value, std::string_view unit);
// "±0.136 mm", "−0.2 to 0.31 mm", "≥ 0 mm", "0.1 mm" if both ends are the same.
std::string IntervalText(const Interval& interval, std::string_view unit);

// "98.1 %"; never 0 or 100 unless it is all of them or none.
std::string RateText(int successes, int trials);
// Wilson's, 95 %: "97.1 to 98.8 %".
std::string WilsonText(int successes, int trials);

// "2 min", of seconds.
std::string DurationText(double seconds);

}  // namespace assay::report
