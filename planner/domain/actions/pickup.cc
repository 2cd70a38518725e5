#include <numeric>

#include "planner/domain/actions/action_template.h"
#include "planner/domain/actions/actions.h"
#include "planner/domain/problem/problem.h"

namespace assay::domain {
namespace {

std::vector<int> AllGrasps(const Part& part) {
  std::vector<int> labels(GraspLabelCount(part));
  std::iota(labels.begin(), labels.end(), 0);
  return labels;
}

// A part that is mated cannot be taken without undoing what was assembled. The hand would lift both
// parts, in a pose that is not one of the held part's own poses.
void DeleteMatings(const Problem& problem, PartId part, std::vector<Condition>& deletes) {
  for (std::size_t m = 0; m < problem.matings.size(); ++m) {
    const Mating& mating = problem.matings[m];
    if (mating.held == part || mating.fixed == part) {
      deletes.push_back(Condition::Assembled(MatingId(m)));
    }
  }
}

ActionTemplate TakingOf(const Problem& problem, PartId part, PlanVariables& variables) {
  const VariableId grasp = variables.Add(VariableKind::kGrasp, part);
  const VariableId position = variables.AddFree(VariableKind::kPosition, part);
  ActionTemplate taking{
      .kind = &kPickup,
      .part = part,
      .grasp = grasp,
      .position = position,
      .preconditions = {Condition::GripperOpen(), Condition::Located(part, position)},
      .geometric = {{.constraint = {.kind = ConstraintKind::kReachable,
                                    .grasp = grasp,
                                    .position = position},
                     .qualifies = {1}}},
      .adds = {Condition::Holding(part, grasp)},
      .deletes = {Condition::GripperOpen(), Condition::Located(part, position)},
      .initial = {{.variable = grasp, .labels = AllGrasps(problem.part(part))}}};
  DeleteMatings(problem, part, taking.deletes);
  return taking;
}

std::vector<ActionTemplate> AchieveByTaking(const Problem& problem, const Condition& condition,
                                            PlanVariables& variables) {
  if (condition.predicate != Predicate::kHolding) return {};
  return {TakingOf(problem, condition.part, variables)};
}

}  // namespace

const ActionKind kPickup{.name = "pickup",
                         .summary = "takes a part from the place where it rests",
                         .arguments = {Argument::kPart, Argument::kGrasp, Argument::kPosition},
                         .short_arguments = {Argument::kPart, Argument::kGrasp},
                         .needs = {Need::kOpenHand, Need::kAtPlace, Need::kAlone},
                         .leaves = Leaves::kInHand,
                         .measured = MeasuredQuantity::kGripperOpening,
                         .achieve = AchieveByTaking};

}  // namespace assay::domain
