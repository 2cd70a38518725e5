#pragma once

#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/checker/checker.h"
#include "planner/plan/data/plan.h"

namespace assay::verify {

// Returns what differs in a plan's certificates, verifications and recoveries when all is computed
// anew from the scenario and the plan's actions. Each difference has its place in the step
// ("certificate.before[0].x[1]"), the file's value and the computed one. Numbers may differ by
// rounding. Expressions whose texts differ are compared as functions, at random points. The claims
// about the arm's ways are computed anew elsewhere (assembly::FlawsOfTravels). If nothing differs,
// resolutions are examined (resolution_check.h).
//
// The plan must have no flaws of other kinds. `file` is the plan's path.
std::vector<plan::Flaw> DifferencesFromAnew(const domain::Problem& problem, const plan::Plan& plan,
                                            const std::string& file);

}  // namespace assay::verify
