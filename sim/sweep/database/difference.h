#pragma once

#include <string>
#include <vector>

#include "sim/sweep/database/records.h"

namespace assay::sweep {

// Returns the differences between two records of one trial, like "simulated: 10.5 and 10.25".
// Returns nothing if they are equal, bit for bit.
std::vector<std::string> Differences(const TrialRecord& stored, const TrialRecord& again);
// Returns the differences between two records of a falsification. The commands in them are ignored.
std::vector<std::string> Differences(const FalsificationRecord& stored,
                                     const FalsificationRecord& again);

}  // namespace assay::sweep
