#pragma once

#include "sim/sweep/database/store.h"

namespace assay::sweep {

// Returns the record of this run of a sweep: its machine, its time and its arguments.
RunRecord ThisRun(const std::string& version, const std::string& shard, int jobs);

}  // namespace assay::sweep
