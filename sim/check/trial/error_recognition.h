#pragma once

#include <vector>

#include "sim/check/contacts/contact_sequence.h"
#include "sim/exec/control/hybrid_control.h"

namespace assay::check {

// How often error states were recognized, and rightly.
struct Recognition {
  int errors = 0;
  int named = 0;
  int right = 0;

  bool operator==(const Recognition&) const = default;
};

struct RecognitionTally {
  Recognition states = {};    // all error states of trials
  Recognition unwanted = {};  // trials in which an unwanted contact was made, by their first name
  int needless = 0;           // error states of the other trials
};

// Whether a contact that was named in an error state was truly there (of a loss: was not) when it
// was felt, in the last hundredth of a second before. By bridged spans: what has just rebounded
// counts as there.
bool IsRight(const exec::RecognizedContact& named, const std::vector<ContactSpan>& bridged);

// Adds the error states of a trial, but for those in motions of which no contacts were observed
// (the way on in the crevice: what is touched there is not planned). `diverged`: another contact
// was made than planned (SequenceComparison::events).
void Count(const exec::StrategyEnd& end, const std::vector<ContactSpan>& bridged, bool diverged,
           RecognitionTally& tally);

}  // namespace assay::check
