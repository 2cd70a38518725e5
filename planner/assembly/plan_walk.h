#pragma once

#include <optional>
#include <vector>

#include "planner/assembly/part_doubts.h"
#include "planner/domain/problem/problem.h"
#include "planner/motion/clear/collision_scene.h"
#include "planner/plan/check/world_state.h"
#include "planner/plan/data/plan.h"
#include "planner/plan/data/tool_doubt.h"
#include "planner/plan/data/tool_route.h"
#include "planner/uncertainty/errors/uncertain_world.h"

namespace assay::assembly {

// Goes through a plan in the order of execution: what is where, how well that is known, and where
// the tool is. After the last step the arm goes home: StepId::None(). For each step ComeTo, then
// whatever is to be known of the way there and of its work, then Do.
class PlanWalk {
 public:
  // Problem and plan must outlive this.
  PlanWalk(const domain::Problem& problem, const plan::Plan& plan,
           uncertainty::Propagation propagation);

  const domain::Problem& problem() const { return problem_; }
  const domain::Workcell& workcell() const { return *problem_.workcell; }
  const plan::Plan& plan() const { return plan_; }

  void ComeTo(plan::StepId id);
  void Do(plan::StepId id);

  plan::ToolRoute RouteTo(plan::StepId id) const;
  // Of the tool, anywhere on the step's route.
  plan::ToolDoubt DoubtOn(plan::StepId id) const;
  // Whether the tool goes on beyond where it works, until it meets resistance.
  bool IsGuarded(plan::StepId id) const;
  // Where the tool is when the travel begins, and whether it first goes straight up to safe height;
  // how far it may be off there.
  const plan::Pose& left() const { return left_; }
  bool rises() const { return rises_; }
  const plan::ToolDoubt& doubt_left() const { return doubt_left_; }

  // Parts are where the plan has them, and doubted about that.
  motion::Surroundings Surroundings() const;
  motion::CollisionScene Scene() const { return {problem_, Surroundings(), arm_}; }

 private:
  void TakeRestingDoubts();

  const domain::Problem& problem_;
  const plan::Plan& plan_;
  plan::WorldState state_;
  uncertainty::UncertainWorld world_;
  PartDoubts doubts_;
  const std::vector<motion::Body> arm_;
  plan::Pose left_;
  bool rises_ = false;
  plan::ToolDoubt doubt_left_;
};

}  // namespace assay::assembly
