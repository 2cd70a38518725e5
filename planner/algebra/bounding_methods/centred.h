#pragma once

#include <span>
#include <vector>

#include "planner/algebra/bounds/probe.h"

namespace assay::algebra {

// Returns an upper bound of the form over a box in which it is defined, given ranges of its partial
// derivatives there. It is the better of the two bounds below.
double UpperBoundByDerivatives(Probe& probe, std::span<const Interval> box,
                               std::span<const Interval> gradient);

// Returns the form's value at a centre c plus, for each variable x, the greatest value of
// derivative * (x - c). The bound is conservative by the mean value theorem. The centre is the one
// that makes the bound least (Baumann 1988).
double CentredUpperBound(Probe& probe, std::span<const Interval> box,
                         std::span<const Interval> gradient);

// Returns true if the form is surely concave in the given variables over the last box of the probe,
// with the other variables fixed: its matrix of second derivatives is negative definite everywhere
// in the box. Call GradientOverBox first.
bool IsConcave(Probe& probe, std::span<const int> variables);

}  // namespace assay::algebra
