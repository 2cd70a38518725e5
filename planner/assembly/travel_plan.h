#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/check/checker.h"
#include "planner/plan/data/plan.h"
#include "planner/uncertainty/errors/uncertain_pose.h"

namespace assay::assembly {

struct TravelEffort {
  int destinations = 4;           // postures at the end of one travel that paths are looked for to
  std::int64_t budget = 100'000;  // of postures looked at in each search (motion::PathRequest)
};

// Gives each step its travel, and what is certain of it (way_conditions.h): the usual one (from
// where the tool is after its retreat straight up, over at safe height and straight down to where
// it is poised), if arm, hand and held part stay free of everything on it, and the arm on the
// straight lines of the work; else a path between the same poses of the tool. Everything stays free
// wherever parts and the arm's joints are within their errors. Only where no such way is found the
// arm's errors are left out, so that the step counts as not proved. Postures are followed as the
// executor chooses them (FollowPath). In paper mode nothing is said of what is certain.
//
// What is in the way of a travel that there is no path for, in words; none if all steps can be
// come to.
std::optional<std::string> AddTravels(
    const domain::Problem& problem, const TravelEffort& effort, plan::Plan& plan,
    uncertainty::Propagation propagation = uncertainty::Propagation::kSound);

// What in the paths of a plan does not hold up: their ends, their clearance, what is claimed of
// them.
std::vector<plan::Flaw> FlawsOfTravels(const domain::Problem& problem, const plan::Plan& plan);

// What two bodies keep from each other in travels, beyond all errors, metres.
inline constexpr double kTravelClearance = 0.005;

}  // namespace assay::assembly
