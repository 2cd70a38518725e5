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

// Returns the verdict on one observation of a claim. The database has one verdict for each step and
// trial, that of the step's worst claim. The verdict on another claim of the step follows from it:
// - If nothing was claimed of the step, the claim was not claimed.
// - If the observation alone would give a worse verdict than the step's, the claim was not claimed.
//   Otherwise the step's verdict would be as bad.
// - All other observations are judged by the claim's prediction and noise floor.
// If the step's certificate is violated, a claim that was not claimed counts as violated, too, if
// its observation is outside its prediction.
ClaimVerdict VerdictOn(const sweep::ClaimRecord& claim, double observed, ClaimVerdict of_step);

// Finds the best, the typical and the worst trial for the report. Trials are ordered by success,
// then by their worst verdict, then by the least margin of their certificates. A margin in radians
// counts as a length at a distance of a tenth of a metre. If there are trials with noise, only
// these are considered.
NotableTrials FindNotable(const sweep::Store& store);

}  // namespace assay::report
