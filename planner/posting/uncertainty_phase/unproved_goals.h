#pragma once

#include <string>
#include <vector>

#include "planner/uncertainty/preconditions/certify.h"

namespace assay::posting {

// The goals that are left when certain conditions are taken care of.
std::vector<uncertainty::Unproved> WithoutConditions(const std::vector<std::string>& absorbed,
                                                     std::vector<uncertainty::Unproved> unproved);

// Whether a goal may be proved with the same grasp and the same side up elsewhere on the table.
bool DependsOnPlace(const uncertainty::Unproved& goal);

// In which the errors occur that matter.
std::vector<algebra::Expression> ExpressionsOf(const std::vector<uncertainty::Unproved>& goals);

// "not proved that ...: SUP 1.2, must be < 1 mm"
std::string WhyUnproved(const plan::CertifiedPrecondition& claim);

}  // namespace assay::posting
