#pragma once

#include <string>
#include <vector>

#include "planner/domain/problem.h"

namespace assay::posting {

// For a problem without a plan of any length (least_actions.h): constraints that cannot hold
// together, in the scenario's own words. Leaving any one of them out would leave a way for every
// part to where it must go.
std::vector<std::string> WhyImpossible(const domain::Problem& problem);

}  // namespace assay::posting
