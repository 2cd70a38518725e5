#include "planner/domain/actions/condition.h"

#include <fmt/format.h>

#include "planner/base/check.h"

namespace assay::domain {

VariableId PlanVariables::Push(PlanVariable variable) {
  variables_.push_back(std::move(variable));
  return VariableId(variables_.size() - 1);
}

VariableId PlanVariables::Add(VariableKind kind, PartId part) {
  const std::string name = kind == VariableKind::kGrasp ? fmt::format("grasp_{}", ++grasps_)
                                                        : fmt::format("pos_{}", ++positions_);
  return Push({.kind = kind, .part = part, .name = name});
}

VariableId PlanVariables::AddFree(VariableKind kind, PartId part) {
  return Push(
      {.kind = kind, .part = part, .name = kind == VariableKind::kGrasp ? "Grasp" : "Position"});
}

VariableId PlanVariables::AddInitialPosition(PartId part) {
  return Push({.kind = VariableKind::kPosition,
               .part = part,
               .name = fmt::format("init_pos_{}", ++initial_positions_)});
}

bool Unify(const Condition& a, const Condition& b) {
  return a.predicate == b.predicate && a.part == b.part && a.mating == b.mating;
}

std::string Text(const Problem& problem, const PlanVariables& variables,
                 const Condition& condition) {
  switch (condition.predicate) {
    case Predicate::kGripperOpen:
      return "gripper(open)";
    case Predicate::kHolding:
      return fmt::format("holding({}, {})", problem.part(condition.part).name,
                         variables[condition.variable].name);
    case Predicate::kPartLocation:
      return fmt::format("part_location({}, {})", problem.part(condition.part).name,
                         variables[condition.variable].name);
    case Predicate::kAssembled: {
      const Mating& mating = problem.mating(condition.mating);
      return fmt::format("assembled({}, {})", problem.part(mating.held).name,
                         problem.part(mating.fixed).name);
    }
  }
  ASSAY_CHECK(false, "a predicate that the switch does not know");
  return {};
}

}  // namespace assay::domain
