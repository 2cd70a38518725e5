#pragma once

#include <string>

#include "planner/contingent/language/domain.h"

namespace assay::contingent {

// A domain or problem as .pks text, in one layout: reading it gives the same again.
std::string TextOf(const Domain& domain);
std::string TextOf(const Problem& problem);

}  // namespace assay::contingent
