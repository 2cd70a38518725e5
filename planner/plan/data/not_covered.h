#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/plan/data/plan.h"

namespace assay::plan {

// The meaning of preconditions kEntry and kSlideIn, after the names of the shaft and the hole,
// where the wrist yields and bevelled edges lead the shaft in.
inline constexpr std::string_view kFitsBetween = "fits between the walls";

// Returns what may make the plan fail though every precondition is proved: the contacts and motions
// of its actions that no condition covers (planner/uncertainty/README.md). Each is named once, in
// the order in which they may first matter.
std::vector<std::string> NotCovered(const Plan& plan);

}  // namespace assay::plan
