#pragma once

#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/check/checker.h"
#include "planner/plan/data/plan.h"

namespace assay::assembly {

// plan::Check, and whether strategies and travels hold up.
plan::CheckReport Check(const domain::Problem& problem, const plan::Plan& plan,
                        int most_linearizations);

// What in the strategies of assembles does not hold up (finemotion::FlawsOfStrategy), and what they
// say to absorb and no strategy does, or errors of velocity that are more than they are certain
// for. Nothing is told of strategies that have no form (plan::FlawsOfForm): plan::Check refuses
// them.
std::vector<plan::Flaw> FlawsOfStrategies(const domain::Problem& problem, const plan::Plan& plan);

}  // namespace assay::assembly
