#pragma once

#include <string>

#include "planner/contingent/language/domain.h"

namespace assay::contingent {

// Returns a domain or problem as .pks text in a fixed layout. Reading the text gives the same
// domain or problem again.
std::string TextOf(const Domain& domain);
std::string TextOf(const Problem& problem);

}  // namespace assay::contingent
