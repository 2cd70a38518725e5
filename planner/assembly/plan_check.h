#pragma once

#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/checker/checker.h"
#include "planner/plan/data/plan.h"

namespace assay::assembly {

// Checks a plan as plan::Check does, and checks its strategies and travels.
plan::CheckReport Check(const domain::Problem& problem, const plan::Plan& plan,
                        int most_linearizations);

// Returns the flaws in the strategies of assembles: flaws of finemotion::FlawsOfStrategy, absorbed
// conditions that no strategy can absorb, and errors of velocity that are greater than the strategy
// allows. Malformed strategies (plan::FlawsOfForm) are skipped, because plan::Check refuses them.
std::vector<plan::Flaw> FlawsOfStrategies(const domain::Problem& problem, const plan::Plan& plan);

}  // namespace assay::assembly
