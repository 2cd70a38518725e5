#pragma once

#include <string>
#include <vector>

#include "planner/uncertainty/preconditions/certify.h"

namespace assay::constraint_posting {

// Returns the goals without those whose conditions are absorbed.
std::vector<uncertainty::Unproved> WithoutConditions(const std::vector<plan::Condition>& absorbed,
                                                     std::vector<uncertainty::Unproved> unproved);

// Returns true if the goal may be proved elsewhere on the table with the same grasp and the same
// stable pose.
bool DependsOnPlace(const uncertainty::Unproved& goal);

// Returns the goals' expressions, which contain the errors on which they depend.
std::vector<algebra::Expression> ExpressionsOf(const std::vector<uncertainty::Unproved>& goals);

// Returns a text such as "not proved that ...: SUP 1.2, must be < 1 mm".
std::string WhyUnproved(const plan::CertifiedPrecondition& claim);

}  // namespace assay::constraint_posting
