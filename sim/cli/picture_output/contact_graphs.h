#pragma once

#include <vector>

#include "planner/finemotion/contact_graph/contact_chain.h"
#include "planner/finemotion/strategy_search/fine_motion_plan.h"
#include "sim/report/html/element.h"

namespace assay::cli {

// Returns a report::ContactGraphPicture for each critical point, with the motions of the plan.
std::vector<report::Element> ContactGraphs(const finemotion::ContactChain& chain,
                                           const finemotion::FineMotionPlan& plan);

}  // namespace assay::cli
