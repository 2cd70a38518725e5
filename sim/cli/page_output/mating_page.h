#pragma once

#include <string>

#include "planner/finemotion/contact_graph/contact_chain.h"
#include "planner/finemotion/strategy_search/fine_motion_plan.h"
#include "planner/finemotion/strategy_search/mating.h"
#include "sim/cli/tasks/mating_trials.h"

namespace assay::cli {

// A trial of the strategy of a mating, and the straight line with the same errors. Both trials have
// samples.
struct ViewedMating {
  const MatingTask& task;
  const finemotion::MatingGeometry& geometry;
  const finemotion::ContactChain& chain;
  const finemotion::FineMotionPlan& plan;  // must have motions
  const scene::SceneOptions& scene;        // of the trials
  const MatedTrial& strategy;
  const MatedTrial& straight;
};

// Returns the page of a mating. Its steps are the motions of the strategy. Each has the contacts of
// the state in which it ends, the errors that are left there, and the graph of contact states.
std::string MatingPage(const ViewedMating& mating);

}  // namespace assay::cli
