#include "planner/constraint_posting/null_plan.h"

#include <variant>
#include <vector>

#include "planner/constraint_posting/least_actions.h"

namespace assay::constraint_posting {

using domain::ActionTemplate;
using domain::Condition;
using domain::LocatedGoal;
using domain::MatingId;
using domain::PartId;
using domain::Problem;
using domain::VariableId;

namespace {

const domain::ActionKind kStartKind{.name = "start"};
const domain::ActionKind kFinishKind{.name = "finish"};

}  // namespace

ActionTemplate InitialWorld(const Problem& problem, domain::PlanVariables& variables) {
  ActionTemplate start{.kind = &kStartKind, .adds = {Condition::GripperOpen()}};
  std::vector<bool> mated(problem.parts.size(), false);
  for (MatingId mating : problem.assembled) {
    start.adds.push_back(Condition::Assembled(mating));
    mated[problem.mating(mating).held.index()] = true;
  }
  for (std::size_t p = 0; p < problem.parts.size(); ++p) {
    if (mated[p]) continue;
    const PartId part(p);
    const VariableId position = variables.AddInitialPosition(part);
    start.adds.push_back(Condition::Located(part, position));
    start.initial.push_back(
        {.variable = position, .labels = {domain::InitialLabel(problem.part(part))}});
  }
  return start;
}

ActionTemplate Goals(const Problem& problem, domain::PlanVariables& variables) {
  ActionTemplate finish{.kind = &kFinishKind};
  for (const domain::Goal& goal : problem.goals) {
    if (const auto* mating = std::get_if<MatingId>(&goal)) {
      finish.preconditions.push_back(Condition::Assembled(*mating));
      continue;
    }
    const auto& located = std::get<LocatedGoal>(goal);
    const VariableId position = variables.AddFree(domain::VariableKind::kPosition, located.part);
    finish.geometric.push_back({.constraint = {.kind = domain::ConstraintKind::kInPositionClass,
                                               .position = position,
                                               .labels = LocatedLabels(problem, located)},
                                .qualifies = {static_cast<int>(finish.preconditions.size())}});
    finish.preconditions.push_back(Condition::Located(located.part, position));
  }
  return finish;
}

}  // namespace assay::constraint_posting
