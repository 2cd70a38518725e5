#pragma once

#include <string>

#include "planner/plan/data/plan.h"
#include "sim/execution/trace/trace.h"
#include "sim/scenario/scenario.h"
#include "sim/scene/scene.h"
#include "sim/view/page.h"

namespace assay::view {

// A scenario's plan, executed once without noise.
struct ViewedExecution {
  scenario::Scenario scenario;
  plan::Plan plan;
  scene::Scene scene;
  execution::Trace trace;

  Subject subject() const {
    return {.problem = scenario.problem,
            .plan = plan,
            .scene = scene,
            .trace = trace,
            .outcome = "succeeded",
            .source = "a <test>",
            .plan_file = "test"};
  }
};

// Returns the execution of figure 15, which is planned and executed only once.
const ViewedExecution& Figure15();
// Returns the execution of a scenario like figure 15. The block is so near to the peg that the way
// to the pickup of the peg, which is the second step, is not proved.
const ViewedExecution& WithAnUnprovedWay();

}  // namespace assay::view
