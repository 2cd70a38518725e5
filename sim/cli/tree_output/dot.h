#pragma once

#include <string>

#include "planner/constraint_posting/partial_plan.h"
#include "planner/contingent/plan_tree/plan_tree.h"
#include "planner/domain/problem/problem.h"
#include "planner/finemotion/contact_graph/contact_chain.h"
#include "planner/plan/data/plan.h"

namespace assay::cli {

// The graphs that the program exports, as texts for Graphviz: plans, networks, contact states and
// plan trees.

// Returns the ordering graph of a plan in the language of Graphviz. It has a node for each step,
// with the step's place in the order of execution, and an arrow to each step that comes after it.
std::string OrderingGraphToDot(const domain::Problem& problem, const plan::Plan& plan);

// Returns the constraint network of a partial plan in the language of Graphviz. It has a node for
// each plan variable, with the labels that are left, and an arc for each constraint between two
// variables (Spar, figures 9 and 10).
std::string ConstraintNetworkToDot(const constraint_posting::PartialPlan& plan);

// Returns the contact states at each critical point in the language of Graphviz. States are in a
// row for each dimension, and an edge joins two states that differ by one contact (Dakin and
// Popplestone, figure 4). Nodes show their contacts and the number of transitions to a goal.
// Initial states are blue and goals green. Bold edges join the states that neighbouring critical
// points share.
std::string ContactChainToDot(const std::string& name, const finemotion::ContactChain& chain);

// Returns a contingent plan in the language of Graphviz. It has a box for each action and a diamond
// for each branch. A dashed edge goes back to repeat what lies between.
std::string PlanTreeToDot(const contingent::GroundTask& task, const contingent::PlanTree& tree);

}  // namespace assay::cli
