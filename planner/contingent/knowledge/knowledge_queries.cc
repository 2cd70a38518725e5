#include "planner/contingent/knowledge/knowledge_queries.h"

#include <algorithm>

#include "planner/contingent/language/decimal.h"

namespace assay::contingent {

bool KnowledgeQueries::Holds(const GroundQuery& query, const KnowledgeState& state) const {
  const auto holds = [&](const GroundQuery& operand) { return Holds(operand, state); };
  switch (query.kind) {
    case GroundQuery::Kind::kAnd:
      return std::all_of(query.operands.begin(), query.operands.end(), holds);
    case GroundQuery::Kind::kOr:
      return std::any_of(query.operands.begin(), query.operands.end(), holds);
    case GroundQuery::Kind::kNot:
      return !MayHold(query.operands.front(), state);
    case GroundQuery::Kind::kKnown:
      return layout_.IsKnown(state, query.literal);
    case GroundQuery::Kind::kBoundKnown:
      return numbers_.Holds(query.bound, state);
    case GroundQuery::Kind::kKnownWhether:
      return layout_.IsSensed(state, query.formula) ||
             IsDetermined(task_.formulas[query.formula.index()], state);
    case GroundQuery::Kind::kValueSensed:
      return IsValueKnown(query, state);
  }
  return false;
}

bool KnowledgeQueries::MayHold(const GroundQuery& query, const KnowledgeState& state) const {
  const auto may_hold = [&](const GroundQuery& operand) { return MayHold(operand, state); };
  switch (query.kind) {
    case GroundQuery::Kind::kAnd:
      return std::all_of(query.operands.begin(), query.operands.end(), may_hold);
    case GroundQuery::Kind::kOr:
      return std::any_of(query.operands.begin(), query.operands.end(), may_hold);
    case GroundQuery::Kind::kNot:
      return !Holds(query.operands.front(), state);
    case GroundQuery::Kind::kKnown: {
      const GroundLiteral negation{query.literal.atom, !query.literal.is_positive};
      return Holds(query, state) ||
             (atoms_.IsOuter(state, query.literal.atom) && !layout_.IsKnown(state, negation));
    }
    case GroundQuery::Kind::kKnownWhether:
      return Holds(query, state) ||
             std::ranges::any_of(
                 task_.formulas[query.formula.index()].literals,
                 [&](const GroundLiteral& literal) { return atoms_.IsOuter(state, literal.atom); });
    case GroundQuery::Kind::kBoundKnown:
      return numbers_.MayHold(query.bound, state);
    case GroundQuery::Kind::kValueSensed:
      return IsValueKnown(query, state) || (numbers_.IsNumber(query.function) &&
                                            numbers_.RangeOf(query.function, state).is_outer);
  }
  return false;
}

bool KnowledgeQueries::IsValueKnown(const GroundQuery& query, const KnowledgeState& state) const {
  const bool is_sensed = layout_.IsSensed(state, query.function);
  if (!numbers_.IsNumber(query.function)) return is_sensed;
  const Range& range = numbers_.RangeOf(query.function, state);
  return WidthOf(range.low, range.high) <= 2 * query.within.value_or(0) ||
         (is_sensed && (!query.within || range.error <= *query.within));
}

bool KnowledgeQueries::IsDetermined(const Formula& formula, const KnowledgeState& state) const {
  if (formula.bound) {
    return numbers_.Holds(*formula.bound, state) || numbers_.Holds(Negation(*formula.bound), state);
  }
  int open = 0;
  for (const GroundLiteral& literal : formula.literals) {
    if (layout_.IsKnown(state, {literal.atom, !literal.is_positive})) return true;
    open += layout_.IsKnown(state, literal) ? 0 : 1;
  }
  return open == 0 || (open > 1 && atoms_.NeverHold(state, formula.literals));
}

bool KnowledgeQueries::IsDetermined(FunctionId function, const KnowledgeState& state) const {
  return std::ranges::any_of(task_.functions[function.index()].values, [&](AtomId value) {
    return layout_.IsKnown(state, {value, true});
  });
}

}  // namespace assay::contingent
