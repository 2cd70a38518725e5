#pragma once

#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/check/checker.h"
#include "planner/plan/data/plan.h"

namespace assay::verify {

// What in a plan's certificates, verifications and recoveries is not as it comes out when all is
// computed anew from the scenario and the plan's actions: each with its place in the step
// ("certificate.before[0].x[1]"), with what the file says and what comes out. Numbers may differ by
// rounding; expressions are compared as functions, where their texts differ at random points.
// What is said of the arm's ways is computed anew elsewhere (assembly::FlawsOfTravels).
// Resolutions, which tell what was done about goals that were not proved before, are not compared.
//
// The plan must have no flaws otherwise. `file`: where it comes from.
std::vector<plan::Flaw> DifferencesFromAnew(const domain::Problem& problem, const plan::Plan& plan,
                                            const std::string& file);

}  // namespace assay::verify
