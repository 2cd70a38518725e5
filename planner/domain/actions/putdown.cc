#include <numeric>

#include "planner/domain/actions/action_template.h"
#include "planner/domain/actions/actions.h"
#include "planner/domain/problem/problem.h"

namespace assay::domain {
namespace {

std::vector<int> AllStablePoses(const Part& part) {
  std::vector<int> labels(part.model->stable_poses().size());
  std::iota(labels.begin(), labels.end(), 0);
  return labels;
}

ActionTemplate PuttingDown(const Problem& problem, PartId part, PlanVariables& variables) {
  const VariableId grasp = variables.AddFree(VariableKind::kGrasp, part);
  const VariableId position = variables.Add(VariableKind::kPosition, part);
  return {.kind = &kPutdown,
          .part = part,
          .grasp = grasp,
          .position = position,
          .preconditions = {Condition::Holding(part, grasp)},
          .geometric = {{.constraint = {.kind = ConstraintKind::kReachable,
                                        .grasp = grasp,
                                        .position = position},
                         .qualifies = {0}}},
          .adds = {Condition::Located(part, position), Condition::GripperOpen()},
          .deletes = {Condition::Holding(part, grasp)},
          .initial = {{.variable = position, .labels = AllStablePoses(problem.part(part))}}};
}

// Putting down any part opens the gripper, so there is one putdown for each.
std::vector<ActionTemplate> AchieveByPuttingDown(const Problem& problem, const Condition& condition,
                                                 PlanVariables& variables) {
  switch (condition.predicate) {
    case Predicate::kPartLocation:
      return {PuttingDown(problem, condition.part, variables)};
    case Predicate::kGripperOpen: {
      std::vector<ActionTemplate> actions;
      for (std::size_t p = 0; p < problem.parts.size(); ++p) {
        actions.push_back(PuttingDown(problem, PartId(p), variables));
      }
      return actions;
    }
    case Predicate::kHolding:
    case Predicate::kAssembled:
      return {};
  }
  return {};
}

}  // namespace

const ActionKind kPutdown{.name = "putdown",
                          .summary = "puts the held part down on the table",
                          .arguments = {Argument::kPart, Argument::kGrasp, Argument::kPosition},
                          .short_arguments = {Argument::kPart, Argument::kPosition},
                          .needs = {Need::kHolding},
                          .leaves = Leaves::kAtPlace,
                          .measured = MeasuredQuantity::kToolHeight,
                          .achieve = AchieveByPuttingDown};

}  // namespace assay::domain
