#pragma once

#include <string>

#include "planner/domain/problem/units.h"

namespace assay::domain {

// What a sensor promises of the poses that it measures: no coordinate is off by more than this,
// either way. Metres and radians.
struct SensorPromise {
  double x = 0;
  double y = 0;
  double z = 0;
  double theta = 0;
};

// "{x: 0.00005, y: 0.00005, z: 0.00004, theta: 0.05}", as a workcell file with these units has it.
// Every number is rounded up to two significant digits, so that nothing more is promised than was
// given.
std::string PromiseText(const SensorPromise& promise, const Units& units);

// The text of a workcell file ("assay-workcell/1"; `file` is its name, for messages) in which this
// sensor's `error` is this promise. All else stays as it is. Where the error ends its line, `note`
// follows as a comment "# calibrated: NOTE", which takes the place of one that was there before.
// Throws InputError where the file has no such sensor or its error is not one map on one line.
std::string WithPromise(const std::string& text, const std::string& file, const std::string& sensor,
                        const SensorPromise& promise, const std::string& note);

}  // namespace assay::domain
