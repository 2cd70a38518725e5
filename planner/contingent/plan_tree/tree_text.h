#pragma once

#include <string>

#include "planner/contingent/plan_tree/plan_tree.h"

namespace assay::contingent {

enum class Sharing {
  kOnce,      // a sub-plan that several branches share is written once, with a number
  kUnfolded,  // every path is written to its end, as in the paper's table II
};

// Returns the tree as text with one line for each action and each branch. The lines after a branch
// are indented:
//   senseWeight(can1)
//   branch isSpillable(can1)
//     transferUpright(can1)
//     go to 1
//   branch !isSpillable(can1)
//     transfer(can1)
//     1: ungrasp(can1)
//
// It must not be used for trees whose branches are nested many thousand deep (SizeOf), because the
// indents would be many thousand characters long.
std::string TextOf(const GroundTask& task, const PlanTree& tree, Sharing sharing);

// Returns the text of a branch's outcome: "isSpillable(can1)", "!isSpillable(can1)", "f(a) = b".
std::string OutcomeText(const GroundTask& task, const PlanNode& node, std::size_t child);

}  // namespace assay::contingent
