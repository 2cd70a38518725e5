#include "planner/algebra/operators/function.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/algebra/operators/operator_rule.h"
#include "planner/base/check.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {

namespace {

constexpr std::size_t kMostOperands = 2;  // of a function

}  // namespace

ExpressionPool* JoinedPool(std::span<const Expression> operands) {
  ExpressionPool* pool = nullptr;
  for (const Expression& operand : operands) {
    if (operand.pool() == pool || operand.pool() == nullptr) continue;
    ASSAY_CHECK(pool == nullptr, "an operation joins expressions of two pools");
    pool = operand.pool();
  }
  return pool;
}

Expression Number(double value, ExpressionPool* pool) {
  if (pool != nullptr) return pool->Constant(value);
  ASSAY_CHECK(!std::isnan(value), "an operation on numbers has no real result");
  return value;
}

Expression InPool(const Expression& e, ExpressionPool* pool) {
  return e.pool() == nullptr && pool != nullptr ? pool->Constant(e.constant()) : e;
}

Interval IntervalOf(const Expression& constant) {
  return {constant.constant(), constant.constant()};
}

bool MayLackValue(Operator op, int exponent) {
  const auto definedness = op.rule().definedness;
  if (definedness == nullptr) return false;
  constexpr std::array<Interval, kMostOperands> kAnything = {kWholeLine, kWholeLine};
  return definedness(std::span(kAnything).first(op.rule().operand_count), exponent) !=
         Definedness::kEverywhere;
}

Expression NodeOf(ExpressionPool& pool, Operator op, std::span<const Expression> operands,
                  int exponent) {
  return pool.Store({.op = op,
                     .operands = operands.data(),
                     .number = exponent,
                     .operand_count = static_cast<std::uint32_t>(operands.size()) & 0x7FFFFFFFU,
                     .may_be_undefined = MayLackValue(op, exponent)});
}

namespace {

// Returns the operator's value if all operands are numbers and the value is exact or there is no
// pool. Returns nothing otherwise.
std::optional<Expression> Folded(Operator op, std::span<const Expression> operands, int exponent) {
  if (!std::ranges::all_of(operands, [](const Expression& e) { return e.IsConstant(); })) {
    return std::nullopt;
  }
  std::array<double, kMostOperands> numbers = {};
  std::array<Interval, kMostOperands> intervals = {};
  for (std::size_t i = 0; i < operands.size(); ++i) {
    numbers[i] = operands[i].constant();
    intervals[i] = IntervalOf(operands[i]);
  }
  const double value = op.rule().value(std::span(numbers).first(operands.size()), exponent);
  ExpressionPool* const pool = JoinedPool(operands);
  if (pool != nullptr) {
    const Interval range = op.rule().range(std::span(intervals).first(operands.size()), exponent);
    if (!(IsSingle(range) && range.low == value)) return std::nullopt;
  }
  return Number(value, pool);
}

}  // namespace

Expression FunctionOf(Operator op, std::span<const Expression> operands, int exponent) {
  if (const auto number = Folded(op, operands, exponent)) return *number;
  ExpressionPool* const pool = JoinedPool(operands);
  std::array<Expression, kMostOperands> stored;
  for (std::size_t i = 0; i < operands.size(); ++i) stored[i] = InPool(operands[i], pool);
  return NodeOf(*pool, op, std::span(stored).first(operands.size()), exponent);
}

}  // namespace assay::algebra
