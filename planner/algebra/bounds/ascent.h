#pragma once

#include <span>
#include <vector>

#include "planner/algebra/bounds/probe.h"

namespace assay::algebra {

// Searches for points where the form is large, in doubles and without any promise: what they find
// counts only once Probe::Offer has certified it. Inequalities are not looked at.

inline constexpr double kNegligible = 1e-15;  // of the value: slopes below end an ascent
inline constexpr double kInvisible = 1e-13;   // of the value: a step that gains less is the last

// From the centre, every variable at once to the end that the gradient points to, while that helps.
std::vector<double> AscendToCorner(Probe& probe, std::span<const Interval> box);

// Newton's method kept in the box and damped where the form is not concave (Levenberg, Marquardt).
std::vector<double> AscendFrom(std::vector<double> start, Probe& probe,
                               std::span<const Interval> box);

}  // namespace assay::algebra
