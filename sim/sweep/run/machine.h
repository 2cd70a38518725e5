#pragma once

#include "sim/sweep/store/store.h"

namespace assay::sweep {

// What this start of the program runs on, and when.
RunRecord ThisRun(const std::string& version, const std::string& shard, int jobs);

}  // namespace assay::sweep
