#pragma once

#include <string_view>

namespace assay {

// The outcomes of a search. The three outcomes are distinguished everywhere, down to the exit
// codes.
enum class Outcome {
  kFound,   // found, for example a plan or a labeling
  kNone,    // proved that there is none
  kBudget,  // no answer: the budget was spent, or the planner reached one of its limits
};

// Returns the outcome's name in results: `found`, "none" or "budget".
constexpr std::string_view Name(Outcome outcome, std::string_view found) {
  return outcome == Outcome::kFound ? found : outcome == Outcome::kNone ? "none" : "budget";
}

}  // namespace assay
