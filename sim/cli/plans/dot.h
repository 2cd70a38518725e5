#pragma once

#include <string>

#include "planner/contingent/tree/plan_tree.h"
#include "planner/domain/problem/problem.h"
#include "planner/finemotion/graph/contact_chain.h"
#include "planner/plan/data/plan.h"
#include "planner/posting/partial_plan.h"

namespace assay::cli {

// The ordering graph of a plan in the language of Graphviz: a node for each step, with its place in
// the order of execution, and an arrow to each step that comes after it.
std::string OrderingGraphToDot(const domain::Problem& problem, const plan::Plan& plan);

// The constraint network of a partial plan: a node for each plan variable with its labels that are
// left, and an arc for each constraint between two of them (Spar, figures 9 and 10).
std::string ConstraintNetworkToDot(const posting::PartialPlan& plan);

// The contact states at each critical point, a row for each dimension, and an edge where one
// contact is made or broken (Dakin and Popplestone, figure 4). Nodes tell their contacts and how
// many transitions it is to a goal; initial states are blue, goals green, and bold edges join the
// states that neighbouring critical points share.
std::string ContactChainToDot(const std::string& name, const finemotion::ContactChain& chain);

// A contingent plan: a box for each action, a diamond for each branch, dashed where it goes back to
// repeat what lies between.
std::string PlanTreeToDot(const contingent::GroundTask& task, const contingent::PlanTree& tree);

}  // namespace assay::cli
