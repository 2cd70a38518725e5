#pragma once

#include <gtest/gtest.h>

#include "planner/base/check.h"
#include "planner/domain/matings/mating_classes.h"
#include "planner/domain/problem/problem_file.h"
#include "planner/domain/reachability/reachability.h"
#include "planner/plan/data/plan.h"
#include "sim/execution/commands/command.h"
#include "sim/scene/scene.h"
#include "tests/planner/plan/actions.h"

namespace assay::execution {

// Returns the problem of Spar's figure 15: the block lies on its back and the peg on its side.
inline domain::Problem Figure15() {
  return domain::ReadProblem(Document::Load(ASSAY_SOURCE_DIR "/scenarios/spar-fig15.yaml"),
                             ASSAY_SOURCE_DIR "/models");
}

inline domain::PartId PartNamed(const domain::Problem& problem, const std::string& name) {
  for (std::size_t i = 0; i < problem.parts.size(); ++i) {
    if (problem.parts[i].name == name) return domain::PartId(i);
  }
  ASSAY_CHECK(false, "no part {}", name);
  return {};
}

// Returns the first grasp with which the peg can be taken where it lies and put into the block.
inline plan::Hold HoldForMating(const domain::Problem& problem, domain::MatingId id) {
  const domain::Mating& mating = problem.mating(id);
  const domain::Part& held = problem.part(mating.held);
  const Pose& X_WorldFixed = problem.part(mating.fixed).X_WorldPart;
  for (std::size_t i = 0; i < held.grasps->size(); ++i) {
    const domain::GraspId grasp(i);
    if (LeavesMatingFeaturesFree(problem, mating, grasp) &&
        IsReachableAt(problem, mating.held, grasp, held.X_WorldPart) &&
        IsMateReachableAt(problem, id, grasp, X_WorldFixed)) {
      const domain::Grasp& g = (*held.grasps)[i];
      return {.grasp = g.label, .X_PartTool = g.X_PartTool, .width = g.width};
    }
  }
  ASSAY_CHECK(false, "no grasp");
  return {};
}

// Returns the plan of the figure, made by hand: pick up the peg, then assemble.
inline plan::Plan TwoActions(const domain::Problem& problem) {
  const domain::MatingId id(0);
  const domain::Mating& mating = problem.mating(id);
  const plan::Hold hold = HoldForMating(problem, id);
  const plan::Place from{"initial", problem.part(mating.held).X_WorldPart};
  const plan::Place fixed{"initial", problem.part(mating.fixed).X_WorldPart};
  return {.problem = problem.name,
          .steps = {{"action_1", plan::Assemble(id, hold, fixed), 1, 2},
                    {"action_2", plan::Pickup(mating.held, hold, from), 2, 1}},
          .ordering = {{plan::StepId(1), plan::StepId(0)}}};
}

// The figure, its plan of two actions and its scene, made once for all tests.
class Figure15Test : public ::testing::Test {
 protected:
  static const domain::Problem& problem() {
    static const domain::Problem problem = Figure15();
    return problem;
  }
  static const plan::Plan& plan() {
    static const plan::Plan plan = TwoActions(problem());
    return plan;
  }
  static const scene::Scene& scene() {
    static const scene::Scene scene(problem(), {});
    return scene;
  }
  static domain::PartId peg() { return PartNamed(problem(), "peg"); }
};

}  // namespace assay::execution
