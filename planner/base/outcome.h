#pragma once

#include <string_view>

namespace assay {

// How a search ended. The three are different answers everywhere, down to the exit codes.
enum class Outcome {
  kFound,   // a plan, a labeling
  kNone,    // proved that there is none
  kBudget,  // no answer: the budget was spent, or a limit of the planner was met
};

}  // namespace assay
