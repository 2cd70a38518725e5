#pragma once

#include <span>
#include <vector>

#include "planner/algebra/bounds/probe.h"

namespace assay::algebra {

// An upper bound of the form over a box where it is defined, given ranges of its partial
// derivatives there: the best of those below.
double UpperBoundByDerivatives(Probe& probe, std::span<const Interval> box,
                               std::span<const Interval> gradient);

// The form's value at a centre c plus, for each variable, the most that derivative * (x - c) can
// be. Conservative by the mean value theorem. The centre is the one for which that most is least
// (Baumann 1988).
double CentredUpperBound(Probe& probe, std::span<const Interval> box,
                         std::span<const Interval> gradient);

// Of a form that is concave over the box: the greatest value of its tangent plane at c, which lies
// nowhere below a concave function. Tight to rounding if c is where the form is largest.
double TangentUpperBound(Probe& probe, std::span<const Interval> box, std::span<const double> c);

// Whether the form is surely concave in the given variables over the last box of the probe (after
// GradientOverBox), the others standing still: its matrix of second derivatives is negative
// definite everywhere.
bool IsConcave(Probe& probe, std::span<const int> variables);

}  // namespace assay::algebra
