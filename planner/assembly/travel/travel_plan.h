#pragma once

#include <optional>

#include "planner/assembly/travel/travel_search.h"
#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "planner/uncertainty/error_sets/uncertain_pose.h"

namespace assay::assembly {

// Adds to each step its travel and the preconditions about the arm that are proved
// (way_conditions.h). The usual travel goes from the tool's pose after its retreat straight up,
// across at safe height, and straight down to the approach pose. It is used if arm, hand and held
// part are clear of everything on it, and the arm is clear on the straight lines of the work.
// Otherwise a path between the same poses of the tool is searched for.
//
// Everything stays clear wherever parts and the arm's joints are within their errors. If this is
// not proved of the usual travel, a path of which it is proved is searched for, to any posture. If
// no such way is found, the arm's errors are ignored, and the step does not count as proved.
// Postures follow the executor's choice (FollowPath). In paper mode no preconditions about the arm
// are added.
//
// Returns the obstruction of a travel for which no path is found. Returns none if all steps can be
// reached.
std::optional<plan::Reason> AddTravels(
    const domain::Problem& problem, TravelEffort& effort, plan::Plan& plan,
    uncertainty::Propagation propagation = uncertainty::Propagation::kSound);

}  // namespace assay::assembly
