#include "planner/domain/actions/action_template.h"
#include "planner/domain/actions/actions.h"
#include "planner/domain/matings/mating_classes.h"
#include "planner/domain/problem/problem.h"

namespace assay::domain {
namespace {

std::vector<ActionTemplate> AchieveByAssembling(const Problem& problem, const Condition& condition,
                                                PlanVariables& variables) {
  if (condition.predicate != Predicate::kAssembled) return {};
  const Mating& mating = problem.mating(condition.mating);
  const VariableId grasp = variables.AddFree(VariableKind::kGrasp, mating.held);
  const VariableId position = variables.AddFree(VariableKind::kPosition, mating.fixed);
  return {{.kind = &kAssemble,
           .part = mating.held,
           .mating = condition.mating,
           .grasp = grasp,
           .position = position,
           .preconditions = {Condition::Holding(mating.held, grasp),
                             Condition::Located(mating.fixed, position)},
           .geometric = {{.constraint = {.kind = ConstraintKind::kMember,
                                         .grasp = grasp,
                                         .labels = GraspList(problem, mating)},
                          .qualifies = {0}},
                         {.constraint = {.kind = ConstraintKind::kInPositionClass,
                                         .position = position,
                                         .labels = PositionList(problem, mating)},
                          .qualifies = {1}},
                         {.constraint = {.kind = ConstraintKind::kMateReachable,
                                         .grasp = grasp,
                                         .position = position,
                                         .mating = condition.mating},
                          .qualifies = {0, 1}}},
           .adds = {Condition::Assembled(condition.mating), Condition::GripperOpen()},
           .deletes = {Condition::Holding(mating.held, grasp)}}};
}

}  // namespace

const ActionKind kAssemble{.name = "assemble",
                           .summary = "mates the held part with a part that rests",
                           .arguments = {Argument::kMating, Argument::kGrasp, Argument::kPosition},
                           .short_arguments = {Argument::kMating},
                           .needs = {Need::kHolding, Need::kAtPlace},
                           .leaves = Leaves::kMated,
                           .measured = MeasuredQuantity::kToolHeight,
                           .achieve = AchieveByAssembling};

}  // namespace assay::domain
