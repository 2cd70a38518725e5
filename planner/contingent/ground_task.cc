#include "planner/contingent/ground_task.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace assay::contingent {

std::string_view TextOf(Relation relation) {
  switch (relation) {
    case Relation::kPredicate:
    case Relation::kExtern:
      return "";
    case Relation::kEqual:
      return "=";
    case Relation::kLess:
      return "<";
    case Relation::kLessOrEqual:
      return "<=";
    case Relation::kGreater:
      return ">";
    case Relation::kGreaterOrEqual:
      return ">=";
  }
  return "";
}

std::string TextOf(const GroundTask& task, const GroundLiteral& literal) {
  return (literal.is_positive ? "" : "!") + task.atoms[literal.atom.index()];
}

std::string TextOf(const GroundTask& task, const Formula& formula) {
  if (formula.bound) {
    return fmt::format("{} {} {}", task.functions[formula.bound->function.index()].text,
                       TextOf(formula.bound->relation), formula.bound->value);
  }
  std::vector<std::string> texts;
  for (const GroundLiteral& literal : formula.literals) texts.push_back(TextOf(task, literal));
  return fmt::format("{}", fmt::join(texts, " & "));
}

std::string TextOf(const GroundAction& action) {
  return fmt::format("{}({})", action.name, fmt::join(action.arguments, ", "));
}

}  // namespace assay::contingent
