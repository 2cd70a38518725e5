#pragma once

#include <map>
#include <string>
#include <vector>

#include "sim/sweep/store/store.h"

namespace assay::sweep {

// What the trials of a cell came to.
struct CellSummary {
  CellRecord cell;
  int done = 0;
  int succeeded = 0;
  std::map<std::string, int> failed = {};  // trials, by outcome
  VerdictCounts certificates = {};         // of all trials together
  int with_errors = 0;                     // trials in which a verification signalled an error
  int recovered = 0;                       // of them, those that succeeded all the same
  int operator_called = 0;                 // trials
};

// In the order of the cells.
std::vector<CellSummary> Summarize(const Store& store);

}  // namespace assay::sweep
