#pragma once

#include <vector>

#include "sim/check/contact_sequence.h"
#include "sim/exec/hybrid_control.h"

namespace assay::check {

// How often the error states of trials were recognized, and rightly.
struct RecognitionTally {
  int errors = 0;
  int named = 0;
  int right = 0;
};

// Whether a contact that was named in an error state at this time was truly there (of a loss: was
// not), in the last hundredth of a second before it. By bridged spans: what has just rebounded
// counts as there.
bool IsRight(const exec::RecognizedContact& named, double time,
             const std::vector<ContactSpan>& bridged);

// Adds the error states of a trial, but for those in motions of which no contacts were observed
// (the way on in the crevice: what is touched there is not planned).
void Count(const exec::StrategyEnd& end, const std::vector<ContactSpan>& bridged,
           RecognitionTally& tally);

}  // namespace assay::check
