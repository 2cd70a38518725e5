#pragma once

#include <map>
#include <string>

#include "planner/domain/problem/problem.h"
#include "sim/sense/color_sensor.h"

namespace assay::enact {

// A measured quantity: the true one is within `error` of it.
struct Reading {
  double value = 0;
  double error = 0;
};

// What sensors have told during a walk, the last of each. All that branches are decided by.
struct Readings {
  std::map<domain::PartId, Reading> masses;  // kg
  std::map<domain::PartId, sense::ColorId> colors;
  std::map<domain::PartId, std::string> poses;  // of parts whose pose was open: its name
  std::map<std::string, std::string> errors;    // of steps of plans: what their verifications
                                                // signal; empty: nothing
};

}  // namespace assay::enact
