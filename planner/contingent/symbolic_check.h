#pragma once

#include <optional>

#include "planner/contingent/tree_check.h"

namespace assay::contingent {

// CheckTree for more worlds than can be run one by one: each node of the tree is looked at once,
// with the set of all worlds that come to it on any way, as a decision diagram (forward images, as
// in Burch, Clarke, McMillan, Dill and Hwang 1992). That can be asked of each world alone only
// where all that a plan asks is K of literals: what is known after some history is what is true in
// each of its worlds. What has been sensed must have been on every way to a node.
//
// None if that does not show that the tree holds, or if there is something else in task or tree:
// a choice of queries (|), functions, update rules, repeats, Kx as an effect, sensing under a
// condition. Shares with the planner the diagrams and their order, which cannot make a wrong set,
// and no inference.
std::optional<TreeCheck> CheckBySets(const GroundTask& task, const PlanTree& tree);

}  // namespace assay::contingent
