#pragma once

#include <numeric>

#include "planner/domain/actions/action_template.h"
#include "planner/domain/actions/actions.h"
#include "planner/domain/problem/problem.h"

namespace assay::constraint_posting {

// A made-up action, which no robot of the models can do. The empty hand tips a part over, without
// a grasp, and leaves it on another side anywhere on the table. This file is everything that the
// planner knows about the action.

inline std::vector<domain::ActionTemplate> AchieveByTippingOver(const domain::Problem& problem,
                                                                const domain::Condition& condition,
                                                                domain::PlanVariables& variables);

inline const domain::ActionKind kTipOver{
    .name = "tip-over",
    .summary = "tips a part over with the empty hand",
    .arguments = {domain::Argument::kPart, domain::Argument::kPosition},
    .short_arguments = {domain::Argument::kPart, domain::Argument::kPosition},
    .needs = {domain::Need::kOpenHand, domain::Need::kAlone},
    .leaves = domain::Leaves::kAtPlace,
    .achieve = AchieveByTippingOver};

inline std::vector<domain::ActionTemplate> AchieveByTippingOver(const domain::Problem& problem,
                                                                const domain::Condition& condition,
                                                                domain::PlanVariables& variables) {
  using domain::Condition;
  if (condition.predicate != domain::Predicate::kPartLocation) return {};
  const domain::PartId part = condition.part;
  const auto before = variables.AddFree(domain::VariableKind::kPosition, part);
  const auto after = variables.Add(domain::VariableKind::kPosition, part);
  std::vector<int> sides(problem.part(part).model->stable_poses().size());
  std::iota(sides.begin(), sides.end(), 0);
  return {{.kind = &kTipOver,
           .part = part,
           .position = after,
           .preconditions = {Condition::GripperOpen(), Condition::Located(part, before)},
           .adds = {Condition::Located(part, after)},
           .deletes = {Condition::Located(part, before)},
           .initial = {{.variable = after, .labels = sides}}}};
}

}  // namespace assay::constraint_posting
