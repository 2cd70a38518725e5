#pragma once

#include <string>

#include "planner/contingent/tree/plan_tree.h"

namespace assay::contingent {

enum class Sharing {
  kOnce,      // a sub-plan that several branches share is told once, with a number
  kUnfolded,  // every way is told to its end, as in the paper's table II
};

// The tree, a line for each action and each branch, what follows a branch indented:
//   senseWeight(can1)
//   branch isSpillable(can1)
//     transferUpright(can1)
//     go to 1
//   branch !isSpillable(can1)
//     transfer(can1)
//     1: ungrasp(can1)
// Not for trees whose branches are nested many thousand deep (SizeOf), as indents would be as long.
std::string TextOf(const GroundTask& task, const PlanTree& tree, Sharing sharing);

// What an outcome of a branch says: "isSpillable(can1)", "!isSpillable(can1)", "f(a) = b".
std::string OutcomeText(const GroundTask& task, const PlanNode& node, std::size_t child);

}  // namespace assay::contingent
