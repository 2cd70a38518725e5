#pragma once

#include <map>
#include <string>

#include "planner/domain/problem/problem.h"
#include "sim/sense/color_sensor.h"

namespace assay::execution {

// A measured value. The true value is within `error` of it.
struct Reading {
  double value = 0;
  double error = 0;
};

// The latest readings of the sensors during a walk. They alone decide which branch of the plan is
// taken.
struct Readings {
  std::map<domain::PartId, Reading> masses;  // kg
  std::map<domain::PartId, sense::ColorId> colors;
  // The name of the observed pose, for parts whose pose was open.
  std::map<domain::PartId, std::string> poses;
  // The error that a step's verification signals, by the step's name; an empty text means no error.
  std::map<std::string, std::string> errors;
};

}  // namespace assay::execution
