#pragma once

#include <string>

#include "planner/domain/problem.h"
#include "planner/plan/plan.h"

namespace assay::cli {

// The ordering graph of a plan in the language of Graphviz: a node for each step, with its place in
// the order of execution, and an arrow to each step that comes after it.
std::string OrderingGraphToDot(const domain::Problem& problem, const plan::Plan& plan);

}  // namespace assay::cli
