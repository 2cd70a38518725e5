#include "tests/sim/view/viewed_execution.h"

#include <fstream>
#include <sstream>
#include <string>

#include "planner/assembly/certified_plan.h"
#include "sim/execution/walk/executor.h"

namespace assay::view {
namespace {

const std::string kFigure15 = ASSAY_SOURCE_DIR "/scenarios/spar-fig15.yaml";

ViewedExecution ExecutionOf(scenario::Scenario scenario) {
  plan::Plan plan = assembly::MakeCertifiedPlan(scenario.problem, {}, {}).plan;
  scene::Scene scene(scenario.problem, scenario.simulation.scene);
  mujoco::Data data = scene.Start();
  execution::Trace trace = execution::Execute(scenario.problem, plan, scene, data, {});
  return {std::move(scenario), std::move(plan), std::move(scene), std::move(trace)};
}

}  // namespace

const ViewedExecution& Figure15() {
  static const ViewedExecution execution = ExecutionOf(scenario::Load(kFigure15));
  return execution;
}

const ViewedExecution& WithAnUnprovedWay() {
  static const ViewedExecution execution = [] {
    const std::string place = "at: [24, 2]";  // of the block
    std::stringstream text;
    text << std::ifstream(kFigure15).rdbuf();
    std::string scenario = text.str();
    scenario.replace(scenario.find(place), place.size(), "at: [24, -1]");
    return ExecutionOf(scenario::Read(Document::Parse(scenario, kFigure15)));
  }();
  return execution;
}

}  // namespace assay::view
