#include "planner/contingent/grounding/ground_query.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace assay::contingent {

GroundQuery ConstantQuery(bool value) {
  GroundQuery query;
  query.kind = value ? GroundQuery::Kind::kAnd : GroundQuery::Kind::kOr;
  return query;
}

GroundQuery Negated(GroundQuery operand) {
  if (operand.IsTrue() || operand.IsFalse()) return ConstantQuery(operand.IsFalse());
  GroundQuery query;
  query.kind = GroundQuery::Kind::kNot;
  query.operands.push_back(std::move(operand));
  return query;
}

GroundQuery Joined(GroundQuery::Kind kind, std::vector<GroundQuery> operands) {
  const bool is_and = kind == GroundQuery::Kind::kAnd;
  GroundQuery query;
  query.kind = kind;
  for (GroundQuery& operand : operands) {
    if (is_and ? operand.IsFalse() : operand.IsTrue()) return ConstantQuery(!is_and);
    if (operand.kind == kind) {
      std::move(operand.operands.begin(), operand.operands.end(),
                std::back_inserter(query.operands));
    } else {
      query.operands.push_back(std::move(operand));
    }
  }
  if (query.operands.size() == 1) return std::move(query.operands.front());
  return query;
}

GroundQuery Known(GroundLiteral literal) {
  GroundQuery query;
  query.kind = GroundQuery::Kind::kKnown;
  query.literal = literal;
  return query;
}

GroundQuery BoundKnown(const Bound& bound) {
  GroundQuery query;
  query.kind = GroundQuery::Kind::kBoundKnown;
  query.bound = bound;
  return query;
}

bool AsksOfTheWorld(const GroundQuery& query) {
  switch (query.kind) {
    case GroundQuery::Kind::kKnown:
    case GroundQuery::Kind::kBoundKnown:
      return true;
    case GroundQuery::Kind::kAnd:
    case GroundQuery::Kind::kOr:
      return std::all_of(query.operands.begin(), query.operands.end(), AsksOfTheWorld);
    case GroundQuery::Kind::kNot:
    case GroundQuery::Kind::kKnownWhether:
    case GroundQuery::Kind::kValueSensed:
      return false;
  }
  return false;
}

bool HasBound(const GroundQuery& query) {
  return query.kind == GroundQuery::Kind::kBoundKnown ||
         std::ranges::any_of(query.operands, HasBound);
}

namespace {

bool HasNegation(const GroundQuery& query) {
  return query.kind == GroundQuery::Kind::kNot || std::ranges::any_of(query.operands, HasNegation);
}

bool AnyNegated(const std::vector<GroundEffect>& effects) {
  return std::ranges::any_of(
      effects, [](const GroundEffect& effect) { return HasNegation(effect.condition); });
}

void AddAskedFor(const GroundTask& task, const GroundQuery& query, std::set<FunctionId>& asked) {
  if (query.kind == GroundQuery::Kind::kBoundKnown) asked.insert(query.bound.function);
  if (query.kind == GroundQuery::Kind::kKnown) {
    asked.insert(task.function_of_atom[query.literal.atom.index()]);
  }
  for (const GroundQuery& operand : query.operands) AddAskedFor(task, operand, asked);
}

// Puts a query of several operands in parentheses, for use beside other operands.
std::string OperandText(const GroundTask& task, const GroundQuery& operand) {
  const std::string text = TextOf(task, operand);
  return operand.operands.size() > 1 ? "(" + text + ")" : text;
}

std::string JoinedText(const GroundTask& task, const GroundQuery& query, const char* word) {
  std::vector<std::string> texts;
  for (const GroundQuery& operand : query.operands) texts.push_back(OperandText(task, operand));
  return fmt::format("{}", fmt::join(texts, word));
}

}  // namespace

bool AsksForIgnorance(const GroundTask& task) {
  return HasNegation(task.goal) || AnyNegated(task.updates) ||
         std::ranges::any_of(task.actions, [](const GroundAction& action) {
           return HasNegation(action.precondition) || AnyNegated(action.effects);
         });
}

std::set<FunctionId> FunctionsAskedFor(const GroundTask& task) {
  std::set<FunctionId> asked;
  const auto add = [&](const std::vector<GroundEffect>& effects) {
    for (const GroundEffect& effect : effects) AddAskedFor(task, effect.condition, asked);
  };
  AddAskedFor(task, task.goal, asked);
  add(task.updates);
  for (const GroundAction& action : task.actions) {
    AddAskedFor(task, action.precondition, asked);
    add(action.effects);
  }
  asked.erase(FunctionId::None());
  return asked;
}

bool HappensByKnowledge(const GroundTask& task) {
  const auto is_by_knowledge = [](const GroundEffect& effect) {
    return !effect.is_of_worlds && !effect.condition.IsTrue();
  };
  return !std::ranges::all_of(task.updates, [](const GroundEffect& update) {
    return update.condition.IsTrue();
  }) || std::ranges::any_of(task.actions, [&](const GroundAction& action) {
    return std::ranges::any_of(action.effects, is_by_knowledge);
  });
}

bool IsMonotone(const GroundTask& task) {
  return !HappensByKnowledge(task) && !HasNegation(task.goal) &&
         std::ranges::none_of(task.actions, [](const GroundAction& action) {
           return HasNegation(action.precondition);
         });
}

std::string TextOf(const GroundTask& task, const GroundQuery& query) {
  using Kind = GroundQuery::Kind;
  switch (query.kind) {
    case Kind::kAnd:
      return query.IsTrue() ? "true" : JoinedText(task, query, " & ");
    case Kind::kOr:
      return query.IsFalse() ? "false" : JoinedText(task, query, " | ");
    case Kind::kNot:
      return "!" + OperandText(task, query.operands.front());
    case Kind::kKnown:
      return "K(" + TextOf(task, query.literal) + ")";
    case Kind::kBoundKnown:
      return "K(" + TextOf(task, Formula{.literals = {}, .bound = query.bound}) + ")";
    case Kind::kKnownWhether:
      return "Kw(" + TextOf(task, task.formulas[query.formula.index()]) + ")";
    case Kind::kValueSensed: {
      const std::string& function = task.functions[query.function.index()].text;
      return query.within ? fmt::format("Kv({} within {})", function, *query.within)
                          : fmt::format("Kv({})", function);
    }
  }
  return "";
}

}  // namespace assay::contingent
