#pragma once

#include <optional>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/plan_tree/plan_tree.h"
#include "planner/contingent/tree_check/tree_check_result.h"

namespace assay::contingent {

// Checks a tree as CheckTree does, for more worlds than can be run one by one. Each node of the
// tree is visited once with the set of all worlds that reach it on any path, as a decision diagram
// (forward images, as in Burch, Clarke, McMillan, Dill and Hwang 1992). A literal that is true in
// each of these worlds is known after every history. A formula that was sensed on every path to a
// node has been sensed. A literal is not known if it is false in each world. It is not known either
// if nothing on any path has said anything about its atom, so that each history allows both values.
//
// The answer is that the tree holds, or that it fails because a required literal is false in one of
// the worlds or because a query fails on every path. Returns none if sets cannot decide this.
// Returns none, too, if task or tree contain a function, an update rule, a repeat, Kx as an effect,
// sensing under a condition, or an effect that depends on knowledge. The check shares with the
// planner the diagrams and their variable order, which cannot make a wrong set, and no inference.
std::optional<TreeCheck> CheckBySets(const GroundTask& task, const PlanTree& tree);

}  // namespace assay::contingent
