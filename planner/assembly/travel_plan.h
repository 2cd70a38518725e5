#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "planner/domain/problem.h"
#include "planner/plan/checker.h"
#include "planner/plan/plan.h"

namespace assay::assembly {

struct TravelEffort {
  int destinations = 4;           // postures at the end of one travel that paths are looked for to
  std::int64_t budget = 100'000;  // of postures looked at in each search (motion::PathRequest)
};

// Looks, step by step, whether arm, hand and held part stay free of everything on the usual travel
// (from where the tool is after its retreat straight up, over at safe height and straight down to
// where it is poised), and whether the arm stays free on the straight lines between; wherever parts
// are within their errors. Where they do not, the plan's step gets a path between the same poses of
// the tool. Postures are followed as the executor chooses them, if nothing errs.
//
// What is in the way of a travel that there is no path for, in words; none if all steps can be
// come to.
std::optional<std::string> AddTravels(const domain::Problem& problem, const TravelEffort& effort,
                                      plan::Plan& plan);

// What in the paths of a plan does not hold up: their ends, their clearance.
std::vector<plan::Flaw> FlawsOfTravels(const domain::Problem& problem, const plan::Plan& plan);

// What two bodies keep from each other in travels, beyond all errors, metres.
inline constexpr double kTravelClearance = 0.005;

}  // namespace assay::assembly
