#pragma once

#include <optional>
#include <vector>

#include "planner/assembly/travel/part_error_bounds.h"
#include "planner/domain/problem/problem.h"
#include "planner/motion/collision/collision_scene.h"
#include "planner/plan/checker/world_state.h"
#include "planner/plan/data/plan.h"
#include "planner/plan/data/tool_error_box.h"
#include "planner/plan/data/tool_route.h"
#include "planner/uncertainty/error_sets/uncertain_world.h"

namespace assay::assembly {

// Follows a plan in the order of execution. It keeps the poses of all parts, the bounds on their
// errors, and the tool's pose. After the last step the arm goes home, which is the step
// StepId::None(). For each step, call ComeTo, then the queries about the step and the way to it,
// then Do.
class PlanWalk {
 public:
  // Problem and plan must outlive the object.
  PlanWalk(const domain::Problem& problem, const plan::Plan& plan,
           uncertainty::Propagation propagation);

  const domain::Problem& problem() const { return problem_; }
  const domain::Workcell& workcell() const { return *problem_.workcell; }
  const plan::Plan& plan() const { return plan_; }

  // Returns the steps in the order of execution, and then the way home. A plan without steps leaves
  // the arm at home.
  std::vector<plan::StepId> Steps() const;

  void ComeTo(plan::StepId id);
  void Do(plan::StepId id);

  plan::ToolRoute RouteTo(plan::StepId id) const;
  // Returns the bound on the tool's error anywhere on the step's route.
  plan::ToolErrorBox DoubtOn(plan::StepId id) const;
  // Returns the parts, other than a held one, on which the step and the step before it work.
  std::vector<domain::PartId> PartsAtWork(plan::StepId id) const;
  // Returns true if the tool continues beyond its planned end pose until it meets resistance.
  bool IsGuarded(plan::StepId id) const;
  // The tool's pose when the travel begins, whether the travel first goes straight up to safe
  // height, and the bound on the tool's error there.
  const plan::Pose& left() const { return left_; }
  bool rises() const { return rises_; }
  const plan::ToolErrorBox& doubt_left() const { return doubt_left_; }

  // Returns the parts at their planned poses, with the bounds on their errors.
  motion::Surroundings Surroundings() const;
  motion::CollisionScene Scene() const { return {problem_, Surroundings(), arm_}; }

 private:
  void TakeRestingDoubts();

  const domain::Problem& problem_;
  const plan::Plan& plan_;
  plan::WorldState state_;
  uncertainty::UncertainWorld world_;
  PartErrorBounds doubts_;
  const std::vector<motion::Body> arm_;
  plan::Pose left_;
  bool rises_ = false;
  plan::ToolErrorBox doubt_left_;
  std::vector<domain::PartId> parts_left_;  // the parts of the step before
};

}  // namespace assay::assembly
