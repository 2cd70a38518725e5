#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sim/report/sections/findings.h"

namespace assay::report {

// What the trials of a cell say of each of its claims and certificates: the
// members `claims`, `counts` and `worst` of its steps, in the order of
// execution.
std::vector<StepFindings> ReadSteps(const sweep::Store& store, int cell);

// The verdict on one observation. The database has a verdict for each step and
// trial, of its worst claim; what follows for another claim of that step:
//   step not claimed    nothing was claimed of the step
//   outside by more than the gate, step not violated, or outside and step
//   contained
//                       it was not claimed, or the step's verdict would be as
//                       bad
// Where a certificate is violated by one claim and another, no longer claimed,
// lies outside as well, that one counts as violated too.
ClaimVerdict VerdictOn(const sweep::ClaimRecord& claim, double observed, ClaimVerdict of_step);

// Best first: whether trials succeeded, then their worst verdict, then the
// least margin of their certificates, radians as lengths at a tenth of a metre.
// Only trials under noise, if there are any.
NotableTrials FindNotable(const sweep::Store& store);

}  // namespace assay::report
