#pragma once

#include <vector>

#include "sim/check/certificate_claims/claim.h"
#include "sim/check/measurements/measurement.h"
#include "sim/check/noise_floor/noise_floor.h"
#include "sim/execution/trace/trace.h"

namespace assay::check {

// Compares the certificates of a plan with what truly happened, and returns the claims of every
// step in the trace. The trace may be of a whole execution or of one that was resumed in between.
//
// The measured margin of a proved precondition must be at least nine tenths of the certified
// margin. A certificate predicts the end of a step on the assumption that the preconditions of this
// and of all earlier steps hold. A precondition that the planner could not prove may fail. If such
// a precondition fails, or if nothing measures whether it fails, nothing is claimed about its step
// or about later steps. Nothing is claimed after a recovery. Preconditions that a strategy absorbs
// are no claims. Three further claims are listed only when they fail: the step is completed, arm
// and hand touch only what they may touch, and only parts that the step handles move.
//
// `first` is the step in which the trace begins; None means the plan's first step. `measurements`
// must have one entry for each kind of precondition in the plan.
std::vector<Claim> CheckCertificates(
    const domain::Problem& problem, const plan::Plan& plan, const execution::Trace& trace,
    const NoiseFloor& gate, plan::StepId first = plan::StepId::None(),
    const std::vector<Measurement>& measurements = KnownMeasurements());

}  // namespace assay::check
