#pragma once

#include <string_view>

namespace assay {

// How a search ended. The three are different answers everywhere, down to the exit codes.
enum class Outcome {
  kFound,   // a plan, a labeling
  kNone,    // proved that there is none
  kBudget,  // the budget was spent before an answer
};

}  // namespace assay
