#include <array>
#include <cmath>

#include "planner/algebra/bounding_methods/first_order_form.h"
#include "planner/algebra/normal_forms/expansion.h"
#include "planner/algebra/operators/function.h"
#include "planner/algebra/operators/operator_rule.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {

// Sine and cosine. Each gives the slope of the other.

const OperatorRule kSinRule = {
    .name = "sin",
    .operand_count = 1,
    .value = [](std::span<const double> x, int) { return std::sin(x[0]); },
    .range = [](std::span<const Interval> x, int) { return Sin(x[0]); },
    .slope = []<class Number>(const FunctionPlace<Number>& at, int) -> Number { return at.b; },
    .curvature = []<class Number>(const FunctionPlace<Number>& at, int, int) -> Number {
      return -at.value;
    },
    .companion = &Operator::kCos,
    .symmetry = Symmetry::kOdd,
    .square =
        [](Expansion& expansion, const Expression& sine, const PolynomialAlgebra::Polynomial&) {
          const Expression cosine = Cos(sine.operands()[0]);
          return OperatorRule::SquareOfAtom{expansion.OneMinusSquareOf(cosine)};
        },
    .first_order =
        [](FirstOrderArithmetic&, std::span<const FirstOrderForm* const> x, int) {
          const double centre = x[0]->centre;
          return FirstOrderArithmetic::Sinusoid(*x[0], std::sin(centre), std::cos(centre));
        },
};

const OperatorRule kCosRule = {
    .name = "cos",
    .operand_count = 1,
    .value = [](std::span<const double> x, int) { return std::cos(x[0]); },
    .range = [](std::span<const Interval> x, int) { return Cos(x[0]); },
    .slope = []<class Number>(const FunctionPlace<Number>& at, int) -> Number { return -at.b; },
    .curvature = []<class Number>(const FunctionPlace<Number>& at, int, int) -> Number {
      return -at.value;
    },
    .companion = &Operator::kSin,
    .follows_companion = true,
    .symmetry = Symmetry::kEven,
    .first_order =
        [](FirstOrderArithmetic&, std::span<const FirstOrderForm* const> x, int) {
          const double centre = x[0]->centre;
          return FirstOrderArithmetic::Sinusoid(*x[0], std::cos(centre), -std::sin(centre));
        },
};

Expression Sin(const Expression& a) { return FunctionOf(Operator::kSin, std::array{a}); }
Expression Cos(const Expression& a) { return FunctionOf(Operator::kCos, std::array{a}); }

}  // namespace assay::algebra
