#include "planner/contingent/ground_query.h"

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

}  // namespace assay::contingent
