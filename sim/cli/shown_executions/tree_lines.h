#pragma once

#include <map>
#include <string>
#include <vector>

#include "planner/contingent/plan_tree/plan_tree.h"
#include "sim/execution/walk/tree_walk.h"
#include "sim/view/way.h"

namespace assay::cli {

// Returns, for a page, the lines of a plan tree as contingent::TextOf has them, with the way that a
// walk went. A sub-plan that several branches share is listed once. `words` are the texts of
// actions for people, where they differ from the task's.
std::vector<view::TreeLine> TreeLines(const contingent::GroundTask& task,
                                      const contingent::PlanTree& tree, const execution::Walk& walk,
                                      const std::map<std::string, std::string>& words);

}  // namespace assay::cli
