#include <algorithm>
#include <array>
#include <cmath>

#include "planner/algebra/operators/function.h"
#include "planner/algebra/operators/operator_rule.h"
#include "planner/algebra/operators/point_or_box.h"
#include "planner/algebra/sup_inf/atom_relations.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {

namespace {

// Returns the derivative with respect to one of two operands: 1 where the extremum is this operand,
// 0 where it is the other one.
template <class Number>
Number SlopeOfExtremum(const FunctionPlace<Number>& at, int operand, bool is_least) {
  const bool first_is_less = High(at.a) < Low(at.b);
  const bool second_is_less = High(at.b) < Low(at.a);
  const Number by_first = !first_is_less && !second_is_less
                              ? Between<Number>(0, 1)
                              : Exactly<Number>(is_least == first_is_less ? 1 : 0);
  return operand == 0 ? by_first : Exactly<Number>(1) - by_first;
}

// The slope jumps where the operands may be equal.
template <class Number>
Number CurvatureOfExtremum(const FunctionPlace<Number>& at) {
  const bool may_be_equal = High(at.a) >= Low(at.b) && High(at.b) >= Low(at.a);
  return may_be_equal ? Unknown<Number>() : Exactly<Number>(0);
}

}  // namespace

// std::min and std::max return the first argument if the second is NaN, so NaN is tested for.
const OperatorRule kMinRule = {
    .name = "min",
    .operand_count = 2,
    .value = [](std::span<const double> x,
                int) { return std::isnan(x[1]) ? x[1] : std::min(x[0], x[1]); },
    .range = [](std::span<const Interval> x, int) { return Min(x[0], x[1]); },
    .slope = []<class Number>(const FunctionPlace<Number>& at, int operand) -> Number {
      return SlopeOfExtremum(at, operand, true);
    },
    .curvature = []<class Number>(const FunctionPlace<Number>& at, int, int) -> Number {
      return CurvatureOfExtremum(at);
    },
    .symmetry = Symmetry::kExchange,
    .relate =
        [](AtomRelations& relations, const Expression& least) {
          for (const Expression& operand : least.operands()) relations.IsAtMost(operand);
        },
    .passes_bounds_through = true,
};

const OperatorRule kMaxRule = {
    .name = "max",
    .operand_count = 2,
    .value = [](std::span<const double> x,
                int) { return std::isnan(x[1]) ? x[1] : std::max(x[0], x[1]); },
    .range = [](std::span<const Interval> x, int) { return Max(x[0], x[1]); },
    .slope = []<class Number>(const FunctionPlace<Number>& at, int operand) -> Number {
      return SlopeOfExtremum(at, operand, false);
    },
    .curvature = []<class Number>(const FunctionPlace<Number>& at, int, int) -> Number {
      return CurvatureOfExtremum(at);
    },
    .symmetry = Symmetry::kExchange,
    .relate =
        [](AtomRelations& relations, const Expression& greatest) {
          for (const Expression& operand : greatest.operands()) relations.NegatedIsAtMost(-operand);
        },
    .passes_bounds_through = true,
};

Expression Min(const Expression& a, const Expression& b) {
  return FunctionOf(Operator::kMin, std::array{a, b});
}
Expression Max(const Expression& a, const Expression& b) {
  return FunctionOf(Operator::kMax, std::array{a, b});
}

}  // namespace assay::algebra
