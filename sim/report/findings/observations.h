#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sim/report/findings/findings.h"

namespace assay::report {

// Returns the findings about the steps of a cell, in the order of execution. Their members
// `claims`, `counts` and `worst` say what the cell's trials show about claims and certificates.
std::vector<StepFindings> ReadSteps(const sweep::Store& store, int cell);

// Finds the best, the typical and the worst trial for the report. Trials are ordered by success,
// then by their worst verdict, then by the least margin of their certificates. A margin in radians
// counts as a length at a distance of a tenth of a metre. If there are trials with noise, only
// these are considered.
NotableTrials FindNotable(const sweep::Store& store);

}  // namespace assay::report
