#include <array>
#include <cmath>

#include "planner/algebra/operators/function.h"
#include "planner/algebra/operators/operator_rule.h"
#include "planner/algebra/operators/point_or_box.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {

const OperatorRule kSqrtRule = {
    .name = "sqrt",
    .operand_count = 1,
    .value = [](std::span<const double> x, int) { return std::sqrt(x[0]); },
    .range = [](std::span<const Interval> x, int) { return Sqrt(x[0]); },
    .definedness =
        [](std::span<const Interval> x, int) {
          if (x[0].high < 0) return Definedness::kNowhere;
          return x[0].low < 0 ? Definedness::kSomewhere : Definedness::kEverywhere;
        },
    .slope = []<class Number>(const FunctionPlace<Number>& at, int) -> Number {
      if (Low(at.a) <= 0) return Unknown<Number>();
      return Exactly<Number>(0.5) * RaisedTo(at.value, -1);
    },
    .curvature = []<class Number>(const FunctionPlace<Number>& at, int, int) -> Number {
      if (Low(at.a) <= 0) return Unknown<Number>();
      return Exactly<Number>(-0.25) * RaisedTo(at.value, -3);
    },
    .square =
        [](Expansion&, const Expression&, const PolynomialAlgebra::Polynomial& operand) {
          return OperatorRule::SquareOfAtom{.base = operand, .power = 1};
        },
};

Expression Sqrt(const Expression& a) { return FunctionOf(Operator::kSqrt, std::array{a}); }

}  // namespace assay::algebra
