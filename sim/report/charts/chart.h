#pragma once

#include "sim/report/findings/findings.h"
#include "sim/report/html/element.h"

namespace assay::report {

// Small drawings in the rows of tables. All drawings of one kind are equally wide, so that a column
// of them reads as one plot. Their classes get their colours from the page's style sheet.

// Returns the mark of a standing. The page shows the word of the standing beside it.
Element Mark(Standing standing);
// Returns the definitions of the shapes of all marks. A page needs them once.
Element MarkDefinitions();

// Returns a chart of a cell's success rates from 0 to 100 %. Each rate is a dot in its Wilson
// interval. The dot is filled for trials with noise, and hollow for trials without noise
// (controls).
Element RateChart(const CellFindings& cell);
// Returns the axis of all rate charts, for the head of their column.
Element RateAxis();

// Returns a bar with the share of each standing.
Element VerdictBar(const StandingCounts& counts);

// Returns a chart of a claim on an axis of its own. A bar shows the prediction, with the noise
// floor beside it. A line from the least to the greatest value shows the observations, with a box
// for their middle half.
Element ErrorChart(const ClaimFindings& claim);

// Returns a chart of multiples of the noise. A bar shows the multiple that is guaranteed, and a
// cross the multiple that broke the plan. `greatest` is the greatest multiple on the axis.
Element ConservatismChart(const sweep::ConservatismRecord& row, double greatest);

}  // namespace assay::report
