#include "planner/contingent/grounding/ground_task.h"

#include <fmt/format.h>

#include <fmt/ranges.h>
#include <algorithm>

#include <cmath>

namespace assay::contingent {

// Rules that only add to Kf come to rest within one round for each atom.
std::size_t MostRoundsOf(const GroundTask& task) { return 1000 + task.atoms.size(); }

bool IsAsserted(const GroundChange& change) {
  return change.kind == GroundChange::Kind::kRelate || change.kind == GroundChange::Kind::kNarrow;
}

bool TellsSomething(const GroundTask& task) {
  const auto tells = [&](const GroundEffect& effect) {
    return std::ranges::any_of(effect.changes, IsAsserted);
  };
  return std::ranges::any_of(task.updates, tells) ||
         std::ranges::any_of(task.actions, [&](const GroundAction& action) {
           return std::ranges::any_of(action.effects, tells);
         });
}

std::set<FormulaId> SensedFormulas(const GroundTask& task) {
  std::set<FormulaId> sensed(task.initial.sensed.begin(), task.initial.sensed.end());
  const auto add = [&](const std::vector<GroundEffect>& effects) {
    for (const GroundEffect& effect : effects) {
      for (const GroundChange& change : effect.changes) {
        if (change.kind == GroundChange::Kind::kSense) sensed.insert(change.formula);
      }
    }
  };
  for (const GroundAction& action : task.actions) add(action.effects);
  add(task.updates);
  return sensed;
}

bool IsUpper(Relation relation) {
  return relation == Relation::kLess || relation == Relation::kLessOrEqual;
}

bool IsStrict(Relation relation) {
  return relation == Relation::kLess || relation == Relation::kGreater;
}

bool SurelyHolds(const Bound& bound, const Range& range) {
  const double end = IsUpper(bound.relation) ? range.high : range.low;
  const bool excludes = IsUpper(bound.relation) ? range.excludes_high : range.excludes_low;
  if (end == bound.value) return excludes || !IsStrict(bound.relation);
  return IsUpper(bound.relation) ? end < bound.value : end > bound.value;
}

Bound Negation(Bound bound) {
  switch (bound.relation) {
    case Relation::kLess:
      bound.relation = Relation::kGreaterOrEqual;
      break;
    case Relation::kLessOrEqual:
      bound.relation = Relation::kGreater;
      break;
    case Relation::kGreater:
      bound.relation = Relation::kLessOrEqual;
      break;
    case Relation::kGreaterOrEqual:
      bound.relation = Relation::kLess;
      break;
    case Relation::kPredicate:
    case Relation::kExtern:
    case Relation::kEqual:
      break;
  }
  return bound;
}

Range Narrowed(Range range, const Bound& bound) {
  if (SurelyHolds(bound, range)) return range;
  (IsUpper(bound.relation) ? range.high : range.low) = bound.value;
  (IsUpper(bound.relation) ? range.excludes_high : range.excludes_low) = IsStrict(bound.relation);
  return range;
}

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

std::string TextOf(const GroundFunction& function, const Range& range) {
  const bool is_open = range.excludes_low || range.excludes_high;
  if (!is_open && std::isfinite(range.low) && std::isfinite(range.high)) {
    return fmt::format("{} = [{}, {}]", function.text, range.low, range.high);
  }
  std::vector<std::string> texts;
  if (std::isfinite(range.low)) {
    texts.push_back(
        fmt::format("{} {} {}", function.text, range.excludes_low ? ">" : ">=", range.low));
  }
  if (std::isfinite(range.high)) {
    texts.push_back(
        fmt::format("{} {} {}", function.text, range.excludes_high ? "<" : "<=", range.high));
  }
  return fmt::format("{}", fmt::join(texts, " & "));
}

std::string TextOf(const GroundAction& action) {
  return fmt::format("{}({})", action.name, fmt::join(action.arguments, ", "));
}

}  // namespace assay::contingent
