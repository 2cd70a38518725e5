#pragma once

#include <vector>

#include "sim/check/claims/claim.h"
#include "sim/check/claims/honesty_gate.h"
#include "sim/exec/execution/trace.h"

namespace assay::check {

// Holds the certificates of a plan against what truly happened, for every step that the trace
// tells of, a whole execution or one that was taken up in between.
//
// A proved precondition is to hold by its certified margin, less a tenth. What a certificate says
// of the end of a step, it says on the assumption that the preconditions of this and of all earlier
// steps hold. One that the planner could not prove may fail: where it does, or where nothing
// measures whether it does, nothing is claimed of its step and from then on. Nor is it after a
// recovery. What a strategy absorbs is no claim. That a step comes to its end and that arm and hand
// touch nothing that they must not are claims, too, which are listed when they fail.
//
// `first`: the step in which the trace begins; None: the plan's first.
std::vector<Claim> CheckCertificates(const domain::Problem& problem, const plan::Plan& plan,
                                     const exec::Trace& trace, const HonestyGate& gate,
                                     plan::StepId first = plan::StepId::None());

}  // namespace assay::check
