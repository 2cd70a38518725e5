#pragma once

#include <map>

#include "planner/domain/problem.h"

namespace assay::enact {

// A measured quantity: the true one is within `error` of it.
struct Reading {
  double value = 0;
  double error = 0;
};

// What sensors have told during a walk, the last of each. All that branches are decided by.
struct Readings {
  std::map<domain::PartId, Reading> masses;  // kg
};

}  // namespace assay::enact
