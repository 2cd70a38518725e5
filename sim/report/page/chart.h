#pragma once

#include "sim/report/page/element.h"
#include "sim/report/sections/findings.h"

namespace assay::report {

// Small drawings that stand in the rows of tables, all of one kind equally
// wide, so that a column of them reads as one plot. Colours come from the
// page's style sheet by class.

// The sign of a standing; its word stands beside it.
Element Mark(Standing standing);
// Defines what the marks look like; once on a page.
Element MarkDefinitions();

// Success rates from 0 to 100 %, each a dot in its Wilson interval: filled
// under noise, hollow for the control arm.
Element RateChart(const CellFindings& cell);
Element RateAxis();

// What share of certificates came out how.
Element VerdictBar(const StandingCounts& counts);

// A claim on an axis of its own: what was predicted as a bar, with the honesty
// gate beside it; what was observed as a line from least to greatest with a box
// of the middle half.
Element ErrorChart(const ClaimFindings& claim);

// Multiples of the noise: what is guaranteed as a bar, what broke the plan as a
// cross. `greatest`: of the axis.
Element ConservatismChart(const sweep::ConservatismRecord& row, double greatest);

}  // namespace assay::report
