#pragma once

#include <string>
#include <vector>

#include "sim/sweep/store/records.h"

namespace assay::sweep {

// In what two records of one trial differ: "simulated: 10.5 and 10.25". Nothing if they are equal,
// bit for bit.
std::vector<std::string> Differences(const TrialRecord& stored, const TrialRecord& again);
// The same for two records of an attack; the commands in them do not matter.
std::vector<std::string> Differences(const AttackRecord& stored, const AttackRecord& again);

}  // namespace assay::sweep
