#pragma once

#include <string>

#include "planner/domain/units/units.h"

namespace assay::domain {

// The promise of a sensor about the poses that it measures: the error of each coordinate is at most
// this, in both directions. Metres and radians.
struct SensorPromise {
  double x = 0;
  double y = 0;
  double z = 0;
  double theta = 0;
};

// Returns the promise as a workcell file with these units writes it: "{x: 0.00005, y: 0.00005, z:
// 0.00004, theta: 0.05}". Every number is rounded up to two significant digits, so that nothing
// more is promised than was given.
std::string PromiseText(const SensorPromise& promise, const Units& units);

// Returns the text of a workcell file ("assay-workcell/1"; `file` is its name, for messages) in
// which this sensor's `error` is this promise. Everything else stays as it is. Where the error ends
// its line, `note` follows as a comment "# calibrated: NOTE", which replaces an earlier such
// comment. Throws InputError if the file has no sensor of that name, or if its error is not one map
// on one line.
std::string WithPromise(const std::string& text, const std::string& file, const std::string& sensor,
                        const SensorPromise& promise, const std::string& note);

}  // namespace assay::domain
