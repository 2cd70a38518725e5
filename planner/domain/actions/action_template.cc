#include "planner/domain/actions/action_template.h"

#include <fmt/format.h>

#include "planner/base/check.h"

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
  return Text(*action.kind, action.kind->short_arguments, [&](Argument argument) -> std::string {
    switch (argument) {
      case Argument::kPart:
        return problem.part(action.part).name;
      case Argument::kMating:
        return fmt::format("{}, {}", problem.part(action.part).name,
                           problem.part(problem.mating(action.mating).fixed).name);
      case Argument::kGrasp:
        return variables[action.grasp].name;
      case Argument::kPosition:
        return variables[action.position].name;
      case Argument::kSensor:
        break;
    }
    ASSAY_CHECK(false, "a partial plan has no action with a sensor");
    return "";
  });
}

}  // namespace assay::domain
