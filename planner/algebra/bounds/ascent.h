#pragma once

#include <span>
#include <vector>

#include "planner/algebra/bounds/probe.h"

namespace assay::algebra {

// Searches for points at which a form is large. The search uses doubles and guarantees nothing: a
// point counts only after Probe::Offer has certified it. Inequalities are ignored.

inline constexpr double kNegligible = 1e-15;  // relative to the value: smaller slopes end an ascent
// A step that gains less than this, relative to the value, is the last one.
inline constexpr double kInvisible = 1e-13;

// Starts at the centre. Moves every variable at once to the end that the gradient points to, and
// repeats this while it helps.
std::vector<double> AscendToCorner(Probe& probe, std::span<const Interval> box);

// Ascends by Newton's method, restricted to the box and damped where the form is not concave
// (Levenberg, Marquardt).
std::vector<double> AscendFrom(std::vector<double> start, Probe& probe,
                               std::span<const Interval> box);

}  // namespace assay::algebra
