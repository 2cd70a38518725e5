#include "planner/algebra/operators/folding.h"

#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "planner/algebra/operators/function.h"
#include "planner/algebra/operators/operator_rule.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {

namespace {

// The operands of a sum or product under construction in a pool.
class OperandList {
 public:
  OperandList(const Folding& folding, ExpressionPool* pool)
      : folding_(folding), pool_(pool), operands_(pool->scratch_operands()) {
    operands_.clear();
  }

  void Add(const Expression& e) {
    if (e.op() == folding_.op && e.operands().size() <= Expression::kMostFlattened) {
      for (const Expression& operand : e.operands()) AddOne(operand);
    } else {
      AddOne(e);
    }
  }

  Expression Finish() {
    if (is_absorbed_) return Number(0, pool_);
    if (operands_.empty()) return Number(folding_.neutral, pool_);
    if (operands_.size() == 1) return operands_[0];
    return NodeOf(*pool_, folding_.op, operands_);
  }

 private:
  void AddOne(const Expression& e) {
    if (!e.IsConstant()) {
      operands_.push_back(e);
    } else if (!e.IsConstant(folding_.neutral)) {
      AddNumber(e.constant());
    }
  }

  // Folds the number with numbers of the list until no two of them fold exactly. The result takes
  // the place of the number that was folded last.
  void AddNumber(double value) {
    if (folding_.is_absorbed_by_zero && value == 0) is_absorbed_ = true;
    std::size_t place = operands_.size();
    for (std::size_t i = 0; i < operands_.size(); ++i) {
      if (!operands_[i].IsConstant()) continue;
      const std::array<double, 2> pair = {operands_[i].constant(), value};
      if (!FoldsExactly(pair)) continue;
      value = folding_.op.rule().value(pair, 0);
      operands_.erase(operands_.begin() + static_cast<std::ptrdiff_t>(i));
      place = std::exchange(i, std::size_t(-1));  // start again from the front
    }
    if (value == folding_.neutral) return;
    operands_.insert(operands_.begin() + static_cast<std::ptrdiff_t>(place), Number(value, pool_));
  }

  bool FoldsExactly(const std::array<double, 2>& pair) const {
    const std::array<Interval, 2> thin = {{{pair[0], pair[0]}, {pair[1], pair[1]}}};
    return IsSingle(folding_.op.rule().range(thin, 0));
  }

  const Folding& folding_;
  ExpressionPool* pool_;
  std::vector<Expression>& operands_;
  bool is_absorbed_ = false;
};

Expression CombinedNumbers(const Folding& folding, std::span<const Expression> numbers) {
  double value = folding.neutral;
  for (const Expression& number : numbers) {
    value = folding.op.rule().value(std::array{value, number.constant()}, 0);
  }
  return Number(value + 0.0, nullptr);  // avoids -0
}

// Returns the result if at most one operand differs from the neutral number, or if one operand
// absorbs the others. This shortcut pays because most operands in products of transforms are 0 or
// 1.
std::optional<Expression> CombinedAtOnce(const Folding& folding, ExpressionPool* pool,
                                         std::span<const Expression> operands) {
  const Expression* result = &operands.front();
  int speaking = 0;
  for (const Expression& operand : operands) {
    if (operand.IsConstant()) {
      const double number = operand.constant();
      if (folding.is_absorbed_by_zero && number == 0) return InPool(operand, pool);
      if (number == folding.neutral) continue;
    }
    result = &operand;
    if (++speaking > 1) return std::nullopt;
  }
  return InPool(*result, pool);
}

}  // namespace

Expression Combined(const Folding& folding, std::span<const Expression> operands) {
  ExpressionPool* const pool = JoinedPool(operands);
  if (pool == nullptr) return CombinedNumbers(folding, operands);
  if (const auto result = CombinedAtOnce(folding, pool, operands)) return *result;
  OperandList list(folding, pool);
  for (const Expression& operand : operands) list.Add(operand);
  return list.Finish();
}

}  // namespace assay::algebra
