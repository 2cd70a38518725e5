#include "tests/sim/view/viewed_execution.h"

#include "planner/assembly/certified_plan.h"
#include "sim/execution/walk/executor.h"

namespace assay::view {
namespace {

ViewedExecution Executed(const std::string& file) {
  scenario::Scenario scenario = scenario::Load(file);
  plan::Plan plan = assembly::MakeCertifiedPlan(scenario.problem, {}, {}).plan;
  scene::Scene scene(scenario.problem, scenario.simulation.scene);
  mujoco::Data data = scene.Start();
  execution::Trace trace = execution::Execute(scenario.problem, plan, scene, data, {});
  return {std::move(scenario), std::move(plan), std::move(scene), std::move(trace)};
}

}  // namespace

const ViewedExecution& Figure15() {
  static const ViewedExecution execution = Executed(ASSAY_SOURCE_DIR "/scenarios/spar-fig15.yaml");
  return execution;
}

}  // namespace assay::view
