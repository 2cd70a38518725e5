#pragma once

#include <vector>

#include "planner/plan/data/plan.h"
#include "sim/exec/execution/trace.h"

namespace assay::check {

// How wide a component of an error set must be for its ends to be told apart in a picture.
struct Sight {
  double length = 0.0003;  // metres
  double angle = 0.0035;   // radians, 0.2 degrees
};

// Where the part of an error set is, world frame, at the ends of each component that can be seen:
// first the low end, then the high one, all others at their middle. At a moment at which the set is
// to hold, as ObservedErrors measures it. A component without bounds has no ends.
std::vector<geometry::Pose> ExtremePoses(const plan::Action& action, const plan::ErrorSet& set,
                                         const exec::Moment& moment, const Sight& sight = {});

}  // namespace assay::check
