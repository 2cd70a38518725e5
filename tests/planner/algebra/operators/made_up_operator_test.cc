#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "planner/algebra/bounds/bounds.h"
#include "planner/algebra/compiled_forms/compiler.h"
#include "planner/algebra/compiled_forms/derivatives.h"
#include "planner/algebra/expression/evaluation.h"
#include "planner/algebra/expression/nodes.h"
#include "planner/algebra/expression/parse.h"
#include "planner/algebra/expression/text.h"
#include "planner/algebra/normal_forms/normalization.h"
#include "planner/algebra/operators/operator_rule.h"
#include "planner/algebra/operators/point_or_box.h"
#include "planner/algebra/sup_inf/sup_inf.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra::made_up_operator_test {
namespace {

// Two operators that the library does not know. This file is all that they need.

// The C library's exponential is within one unit in the last place.
const OperatorRule kExpRule = {
    .name = "exp",
    .operand_count = 1,
    .value = [](std::span<const double> x, int) { return std::exp(x[0]); },
    .range =
        [](std::span<const Interval> x, int) {
          return Interval{RoundedDown(RoundedDown(std::exp(x[0].low))),
                          RoundedUp(RoundedUp(std::exp(x[0].high)))};
        },
    .slope = []<class Number>(const FunctionPlace<Number>& at, int) -> Number { return at.value; },
    .curvature = []<class Number>(const FunctionPlace<Number>& at, int, int) -> Number {
      return at.value;
    },
};

const OperatorRule kHypotRule = {
    .name = "hypot",
    .operand_count = 2,
    .value = [](std::span<const double> x, int) { return std::sqrt(x[0] * x[0] + x[1] * x[1]); },
    .range = [](std::span<const Interval> x, int) { return Sqrt(Power(x[0], 2) + Power(x[1], 2)); },
    .slope = []<class Number>(const FunctionPlace<Number>& at, int operand) -> Number {
      return (operand == 0 ? at.a : at.b) * RaisedTo(at.value, -1);
    },
    .curvature = []<class Number>(const FunctionPlace<Number>& at, int i, int j) -> Number {
      const Number scale = RaisedTo(at.value, -3);
      if (i != j) return Exactly<Number>(-1) * at.a * at.b * scale;
      return RaisedTo(i == 0 ? at.b : at.a, 2) * scale;
    },
};

constexpr Operator kExp(kExpRule);
constexpr Operator kHypot(kHypotRule);

class MadeUpOperator : public testing::Test {
 protected:
  Expression Read(std::string_view text) { return Parse(text, pool_, {}); }
  Expression Exp(const Expression& e) { return Apply(kExp, std::array{e}); }

  ExpressionPool pool_{{kExp, kHypot}};
  Expression x_ = pool_.Declare("x", {-1, 2});
  Expression y_ = pool_.Declare("y", {3, 4});
};

TEST_F(MadeUpOperator, IsPrintedAndParsed) {
  const Expression e = 1 - 2 * Exp(x_ + 1) * Apply(kHypot, std::array{x_, 2 * y_});
  EXPECT_EQ(Text(e), "1 - 2*exp(x + 1)*hypot(x, 2*y)");
  EXPECT_EQ(Read(Text(e)), e);
  EXPECT_THROW(Read("exp(x, y)"), InputError);
}

TEST_F(MadeUpOperator, IsKnownToItsPoolAlone) {
  ExpressionPool other;
  other.Declare("x", {0, 1});
  EXPECT_THROW(Parse("exp(x)", other, {}), InputError);
}

TEST_F(MadeUpOperator, IsEvaluated) {
  const Expression e = Read("exp(x) + hypot(x, y)");
  EXPECT_DOUBLE_EQ(Evaluate(e, std::vector{1.5, 2.0}), std::exp(1.5) + 2.5);
  const Interval range = Evaluate(e, std::vector<Interval>{{0, 1}, {3, 4}});
  EXPECT_LE(range.low, 4);
  EXPECT_NEAR(range.low, 4, 1e-14);
  EXPECT_GE(range.high, std::exp(1.0) + std::sqrt(17.0));
  EXPECT_NEAR(range.high, std::exp(1.0) + std::sqrt(17.0), 1e-14);
}

TEST_F(MadeUpOperator, IsAnAtomOfNormalForms) {
  EXPECT_EQ(NormalFormOf(Exp(x_ + y_ - x_) * 2 - Exp(y_)), NormalFormOf(Exp(y_)));
}

TEST_F(MadeUpOperator, IsDifferentiated) {
  const Expression e = Read("x*exp(x*y) + hypot(x^2, 3*y)");
  const CompiledForm form = Compile(NormalFormOf(e), VariablesOf(e));
  Derivatives<double> at_point(form);
  const auto gradient_at = [&](double x, double y) {
    at_point.Value(std::array{x, y});
    return at_point.Gradient();
  };
  const double step = 1e-6;
  const std::vector<double> slope = gradient_at(0.5, 1.25);
  const std::vector<double> curvature = at_point.SecondDerivatives(0);
  const auto value = [&](double x, double y) { return Evaluate(e, std::vector{x, y}); };
  EXPECT_NEAR(slope[0], (value(0.5 + step, 1.25) - value(0.5 - step, 1.25)) / (2 * step), 1e-8);
  EXPECT_NEAR(slope[1], (value(0.5, 1.25 + step) - value(0.5, 1.25 - step)) / (2 * step), 1e-8);
  const std::vector<double> right = gradient_at(0.5 + step, 1.25);
  const std::vector<double> left = gradient_at(0.5 - step, 1.25);
  for (int i : {0, 1}) EXPECT_NEAR(curvature[i], (right[i] - left[i]) / (2 * step), 1e-8);

  Derivatives<Interval> over_box(form);
  over_box.Value(std::array<Interval, 2>{{{0.4, 0.6}, {1.2, 1.3}}});
  for (int i : {0, 1}) EXPECT_TRUE(Contains(over_box.Gradient()[i], slope[i]));
  for (int i : {0, 1}) EXPECT_TRUE(Contains(over_box.SecondDerivatives(0)[i], curvature[i]));
}

// exp(x) - x is least at 0 and greatest at an end.
TEST_F(MadeUpOperator, IsBounded) {
  const Expression e = Exp(x_) - x_;
  const BoundRequest request = {.gap = 1e-9, .evaluations = 100'000};
  const Bound sup = BoundAbove(e, DeclaredBox(pool_), request);
  const Bound inf = BoundBelow(e, DeclaredBox(pool_), request);
  EXPECT_NEAR(sup.value, std::exp(2.0) - 2, 2e-9);
  EXPECT_GE(sup.value, std::exp(2.0) - 2);
  EXPECT_NEAR(inf.value, 1, 2e-9);
  EXPECT_LE(inf.value, 1);
  const Expression sup_inf = Sup(e, {}, DeclaredBox(pool_));
  EXPECT_GE(sup_inf.constant(), std::exp(2.0) - 2);
}

}  // namespace
}  // namespace assay::algebra::made_up_operator_test
