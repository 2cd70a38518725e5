#pragma once

#include <vector>

#include "planner/plan/data/plan.h"
#include "sim/execution/trace/trace.h"

namespace assay::check {

// The least width of an error component whose two ends can be distinguished in a picture.
struct Sight {
  double length = 0.0003;  // metres
  double angle = 0.0035;   // radians, 0.2 degrees
};

// Returns, for pictures of a trial, extreme poses of the part of an error set, in the world frame,
// at a snapshot in which the set is to hold (see ObservedErrors). Each component that is wider than
// `sight` gives two poses: first its low end, then its high end, with all other components at their
// middle. A component without bounds gives none.
std::vector<geometry::Pose> ExtremePoses(const plan::Action& action, const plan::ErrorSet& set,
                                         const execution::Snapshot& snapshot,
                                         const Sight& sight = {});

}  // namespace assay::check
