#include "planner/domain/actions/action_template.h"

#include <fmt/format.h>

namespace assay::domain {

std::string LabelName(const Problem& problem, const PlanVariable& variable, int label) {
  const Part& part = problem.part(variable.part);
  if (variable.kind == VariableKind::kGrasp) return (*part.grasps)[label].label;
  return label == InitialLabel(part) ? "initial" : part.model->stable_poses()[label].label;
}

namespace {

// Lists the labels if there are at most 8, and gives only their number otherwise: people want to
// see a short list whole, and for a long one the number is enough.
std::string LabelList(const Problem& problem, const PlanVariable& variable,
                      const std::vector<int>& labels) {
  if (labels.size() > 8) return fmt::format("[{} labels]", labels.size());
  std::string text;
  for (int label : labels) {
    text += (text.empty() ? "" : ", ") + LabelName(problem, variable, label);
  }
  return "[" + text + "]";
}

}  // namespace

std::string Text(const Problem& problem, const PlanVariables& variables,
                 const GeometricConstraint& constraint) {
  const auto name = [&](VariableId id) { return variables[id].name; };
  const auto labels = [&] {
    return LabelList(problem, variables[constraint.subject()], constraint.labels);
  };
  switch (constraint.kind) {
    case ConstraintKind::kMember:
      return fmt::format("member({}, {})", name(constraint.subject()), labels());
    case ConstraintKind::kInPositionClass:
      return fmt::format("in_position_class({}, {})", name(constraint.position), labels());
    case ConstraintKind::kReachable:
      return fmt::format("reachable({}, {})", name(constraint.grasp), name(constraint.position));
    case ConstraintKind::kMateReachable:
      return fmt::format("mate_reachable({}, {}, Ta)", name(constraint.grasp),
                         name(constraint.position));
  }
  return "";
}

std::string Text(const Problem& problem, const PlanVariables& variables,
                 const ActionTemplate& action) {
  const auto part = [&](PartId id) { return problem.part(id).name; };
  switch (action.kind) {
    case ActionKind::kStart:
    case ActionKind::kFinish:
      return std::string(Name(action.kind));
    case ActionKind::kPickup:
      return fmt::format("pickup({}, {})", part(action.part), variables[action.grasp].name);
    case ActionKind::kPutdown:
      return fmt::format("putdown({}, {})", part(action.part), variables[action.position].name);
    case ActionKind::kAssemble:
      return fmt::format("assemble({}, {})", part(action.part),
                         part(problem.mating(action.mating).fixed));
  }
  return "";
}

}  // namespace assay::domain
