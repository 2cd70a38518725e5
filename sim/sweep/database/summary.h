#pragma once

#include <map>
#include <string>
#include <vector>

#include "sim/sweep/database/store.h"

namespace assay::sweep {

// The results of the trials of a cell.
struct CellSummary {
  CellRecord cell;
  int done = 0;
  int succeeded = 0;
  std::map<std::string, int> failed = {};  // failed trials by outcome
  VerdictCounts certificates = {};         // the sum over all trials
  int with_errors = 0;                     // trials in which a verification signalled an error
  int recovered = 0;                       // trials with a signalled error that succeeded
  int operator_called = 0;                 // trials in which a person was called
};

// Returns the summaries in the order of the cells.
std::vector<CellSummary> Summarize(const Store& store);

}  // namespace assay::sweep
