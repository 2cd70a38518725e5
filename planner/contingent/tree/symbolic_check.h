#pragma once

#include <optional>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/tree/plan_tree.h"
#include "planner/contingent/tree/tree_check_result.h"

namespace assay::contingent {

// CheckTree for more worlds than can be run one by one: each node of the tree is looked at once,
// with the set of all worlds that come to it on any way, as a decision diagram (forward images, as
// in Burch, Clarke, McMillan, Dill and Hwang 1992). What is true in each of these worlds is known
// after every history; what was sensed on every way to a node has been sensed. That a literal is
// not known shows where it is false in each world, or where nothing on any way has told anything of
// its atom, so that each history has it both ways.
//
// The tree holds, or it fails: a literal that must be known is false in one of the worlds, or what
// is asked fails on every way. None if sets cannot tell, or if there is something else in task or
// tree: functions, update rules, repeats, Kx as an effect, sensing under a condition, effects by
// what is known or not known. Shares with the planner the diagrams and their order, which cannot
// make a wrong set, and no inference.
std::optional<TreeCheck> CheckBySets(const GroundTask& task, const PlanTree& tree);

}  // namespace assay::contingent
