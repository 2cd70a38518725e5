#pragma once

#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/checker/checker.h"
#include "planner/plan/data/plan.h"
#include "planner/uncertainty/error_sets/uncertain_world.h"

namespace assay::verify {

// Returns what is wrong with the resolutions of a plan, which say how goals that were not proved at
// first were resolved:
//
// - Each look and each squeeze must belong to one resolution of a later step, whose resolver makes
//   such steps. A step has a strategy if and only if fine motion is one of its resolutions.
// - A step says that it is verified if and only if it is not proved.
// - The reason must be the goal that fails by the greatest amount without the remedies for this
//   step and for later ones. Its numbers may differ by rounding.
//
// Two things are not computed anew, since they depend on plans that the planner gave up. These are
// the reasons for which parts were moved, and what remained unproved with remedies that move no
// part.
//
// The plan must be executable, and its certificates must be right.
std::vector<plan::Flaw> FlawsOfResolutions(const domain::Problem& problem, const plan::Plan& plan,
                                           uncertainty::Propagation propagation);

}  // namespace assay::verify
