#pragma once

#include <vector>

#include "sim/check/contact_sequences/contact_sequence.h"
#include "sim/execution/control/hybrid_control.h"

namespace assay::check {

// Counts of error states: all of them, those in which a contact was named, and those in which the
// named contact was right.
struct Recognition {
  int errors = 0;
  int named = 0;
  int right = 0;

  bool operator==(const Recognition&) const = default;
};

// The counts of error states over many trials.
struct RecognitionTally {
  Recognition states = {};  // error states of all trials
  // One entry for each trial in which an unwanted contact was made: the first contact that was
  // named.
  Recognition unwanted = {};
  int needless = 0;  // error states of trials in which no unwanted contact was made
};

// Returns whether the contact that was named in an error state truly existed at some time in the
// hundredth of a second before it was felt. If the error state names the loss of a contact, the
// contact must have been absent at such a time. `bridged` holds spans from Bridged, so that a
// contact that has just rebounded counts as present.
bool IsRight(const execution::RecognizedContact& named, const std::vector<ContactSpan>& bridged);

// Adds the error states of one trial to `tally`. Error states in motions whose contacts were not
// observed are left out. An example is the last slide in the hole, for which no contacts are
// planned. `diverged` says that another contact was made than planned (SequenceComparison::events).
void Count(const execution::StrategyEnd& end, const std::vector<ContactSpan>& bridged,
           bool diverged, RecognitionTally& tally);

}  // namespace assay::check
