#include "planner/algebra/expression/expression.h"
#include "planner/algebra/expression/evaluation.h"
#include "planner/algebra/expression/nodes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <span>

#include "planner/numeric/interval_arithmetic.h"
#include "tests/planner/algebra/random_expression.h"

namespace assay::algebra::expression_test {
namespace {

using testing::ElementsAre;

class ExpressionTest : public testing::Test {
 protected:
  double At(const Expression& e, double x_value, double y_value) {
    const std::array<double, 2> point = {x_value, y_value};
    return Evaluate(e, std::span<const double>(point));
  }

  ExpressionPool pool_;
  Expression x_ = pool_.Declare("x", {-1, 2});
  Expression y_ = pool_.Declare("y", {0, 3});
};

TEST_F(ExpressionTest, EqualSubexpressionsAreStoredOnce) {
  const Expression first = Sin(x_ + 2 * y_) * Cos(x_);
  const int count = pool_.node_count();
  EXPECT_EQ(Sin(x_ + 2 * y_) * Cos(x_), first);
  EXPECT_EQ(pool_.node_count(), count);
  EXPECT_NE(Sin(x_ + 3 * y_) * Cos(x_), first);
  EXPECT_NE(Power(x_, 2), Power(x_, 3));
  EXPECT_NE(x_, y_);
}

TEST_F(ExpressionTest, NumbersAreEqualByValue) {
  EXPECT_EQ(Expression(2), pool_.Constant(2));
  EXPECT_EQ(pool_.Constant(-0.0), Expression(0));
  EXPECT_NE(Expression(2), x_);
  EXPECT_EQ(Expression(2).index(), -1);
  EXPECT_EQ(Expression(2).pool(), nullptr);
}

TEST_F(ExpressionTest, RootsAndDivisionsMayBeUndefinedWhereverTheyStand) {
  EXPECT_TRUE((1 + 2 * Sin(Sqrt(x_))).MayBeUndefined());
  EXPECT_TRUE(Max(y_, x_ * (1 / y_)).MayBeUndefined());
  EXPECT_TRUE(Cos(Power(x_, -2)).MayBeUndefined());
  EXPECT_FALSE((Power(x_, 2) + Abs(Sin(x_ * y_))).MayBeUndefined());
  EXPECT_FALSE(Expression(2).MayBeUndefined());
}

TEST_F(ExpressionTest, NeutralAndAbsorbingNumbers) {
  EXPECT_EQ(x_ + 0, x_);
  EXPECT_EQ(0 + x_, x_);
  EXPECT_EQ(1 * x_, x_);
  EXPECT_EQ(x_ / 1, x_);
  EXPECT_EQ(x_ * 0, Expression(0));
  EXPECT_EQ(Power(x_, 1), x_);
  EXPECT_EQ(Power(x_, 0), Expression(1));
  EXPECT_EQ(-(-x_), x_);
  EXPECT_EQ(-(-(x_ + y_)), x_ + y_);
  EXPECT_EQ(Sin(pool_.Constant(0)), Expression(0));
  EXPECT_EQ(Cos(pool_.Constant(0)), Expression(1));
}

TEST_F(ExpressionTest, NumbersInAPoolFoldOnlyExactly) {
  EXPECT_EQ(pool_.Constant(0.5) + 0.25, Expression(0.75));
  EXPECT_EQ((pool_.Constant(0.1) + 0.2).op(), Operator::kSum);
  EXPECT_EQ((x_ + 0.1 + 0.2).operands().size(), 3U);
  EXPECT_EQ((x_ + 1 + 2).operands().size(), 2U);
  EXPECT_EQ(2 * x_ * 3, 6 * x_);
  EXPECT_EQ((pool_.Constant(1) / 3).op(), Operator::kQuotient);
  EXPECT_EQ(pool_.Constant(1) / 4, Expression(0.25));
  EXPECT_EQ(Sqrt(pool_.Constant(9)), Expression(3));
  EXPECT_EQ(Sqrt(pool_.Constant(2)).op(), Operator::kSqrt);
  EXPECT_EQ(Power(pool_.Constant(-2), 3), Expression(-8));
  // Without a pool of expressions, operations on constants are computed at once.
  EXPECT_EQ(Expression(0.1) + 0.2, Expression(0.1 + 0.2));
  EXPECT_EQ(Sin(Expression(1)), Expression(std::sin(1.0)));
}

TEST_F(ExpressionTest, WhatHasNoRealValueStandsAsWritten) {
  EXPECT_EQ((pool_.Constant(1) / 0).op(), Operator::kQuotient);
  EXPECT_EQ(Power(pool_.Constant(0), -1).op(), Operator::kPower);
  EXPECT_EQ(Sqrt(pool_.Constant(-1)).op(), Operator::kSqrt);
  EXPECT_TRUE(std::isnan(At(1 / (x_ - y_), 1, 1)));
  EXPECT_TRUE(std::isnan(At(Power(x_, -2), 0, 1)));
  EXPECT_TRUE(std::isnan(At(Min(1, Sqrt(x_)), -1, 0)));
  EXPECT_TRUE(std::isnan(At(Max(Sqrt(x_), 1), -1, 0)));
}

TEST_F(ExpressionTest, SumsAndProductsAreFlat) {
  EXPECT_THAT(((x_ + y_) + (Sin(x_) + 1)).operands(), ElementsAre(x_, y_, Sin(x_), 1));
  EXPECT_THAT(((x_ * y_) * (y_ * 3)).operands(), ElementsAre(x_, y_, y_, 3));
  EXPECT_THAT((x_ - y_).operands(), ElementsAre(x_, -y_));
}

TEST_F(ExpressionTest, OperandsStayWhereTheyAreWhileThePoolGrows) {
  const Expression sum = x_ + y_;
  const std::span<const Expression> operands = sum.operands();
  for (int i = 0; i < 20'000; ++i) pool_.Constant(i) * x_ + y_;
  EXPECT_EQ(operands.data(), sum.operands().data());
  EXPECT_THAT(operands, ElementsAre(x_, y_));
}

TEST_F(ExpressionTest, VariablesAreFoundByName) {
  EXPECT_EQ(pool_.variable_count(), 2);
  EXPECT_EQ(pool_.Find("y"), y_.variable());
  EXPECT_EQ(pool_.Find("z"), std::nullopt);
  EXPECT_EQ(pool_.name(x_.variable()), "x");
  EXPECT_EQ(pool_.bounds(y_.variable()), (Interval{0, 3}));
  EXPECT_EQ(pool_.Variable(x_.variable()), x_);
  EXPECT_THAT(VariablesOf(Sin(y_) + 1), ElementsAre(y_.variable()));
  EXPECT_THAT(VariablesOf(y_ * x_ / y_), ElementsAre(x_.variable(), y_.variable()));
  EXPECT_THAT(VariablesOf(3), ElementsAre());
}

TEST_F(ExpressionTest, BrokenInvariantsStopTheProgram) {
  EXPECT_DEATH(pool_.Declare("x", {0, 1}), "twice");
  EXPECT_DEATH(pool_.Declare("2x", {0, 1}), "name");
  EXPECT_DEATH(pool_.Declare("z", {1, 0}), "bounds");
  EXPECT_DEATH(pool_.Declare("z", {std::nan(""), 0}), "bounds");
  EXPECT_DEATH(pool_.Constant(std::nan("")), "NaN");
  EXPECT_DEATH(Expression(1) / 0, "divided by 0");
  ExpressionPool other;
  EXPECT_DEATH(other.Declare("z", {0, 1}) + x_, "two pools");
}

TEST_F(ExpressionTest, NodesComeAfterTheirOperands) {
  const Expression shared = Sin(x_ + y_);
  const std::vector<Expression> nodes = NodesOf(shared * shared + x_);
  for (std::size_t i = 1; i < nodes.size(); ++i) EXPECT_LT(nodes[i - 1].index(), nodes[i].index());
  EXPECT_EQ(nodes.size(), 6U);  // x, y, their sum, its sine, the square, the whole
}

TEST_F(ExpressionTest, DepthCostsNoStackAndSharingNoTime) {
  Expression deep = x_;
  for (int i = 0; i < 10'000; ++i) deep = Sin(deep) / 2 + y_;
  EXPECT_TRUE(std::isfinite(At(deep, 0.5, 1)));
  const std::vector<Interval> box = {{-1, 2}, {0, 3}};
  EXPECT_TRUE(Contains(Evaluate(deep, std::span<const Interval>(box)), At(deep, 0.5, 1)));
  EXPECT_EQ(VariablesOf(deep).size(), 2U);

  Expression doubled = x_;  // written as a tree it would have 2^100 leaves
  Expression squared = x_;
  for (int i = 0; i < 100; ++i) {
    doubled = doubled + doubled;
    squared = Cos(squared * squared);
  }
  EXPECT_EQ(At(doubled, 1, 0), 0x1p100);
  EXPECT_TRUE(std::isfinite(At(squared, 1, 0)));

  Expression chain = x_;
  const int nodes_before = pool_.node_count();
  for (int i = 0; i < 20'000; ++i) chain = chain + y_ * i;
  EXPECT_LT(pool_.node_count(), nodes_before + 70'000);
  EXPECT_EQ(At(chain, 1, 1), 1 + 19'999 * 10'000);
}

TEST_F(ExpressionTest, IntervalEvaluationHoldsEveryValue) {
  RandomStream random(1, "interval evaluation");
  for (int i = 0; i < 2'000; ++i) {
    RandomExpressions expressions(random, 3);
    const Expression e = expressions.Draw(6);
    const std::vector<Interval> box(3, Interval{-2, 2});
    const Interval range = Evaluate(e, std::span<const Interval>(box));
    for (int k = 0; k < 10; ++k) {
      const double value = Evaluate(e, std::span<const double>(expressions.DrawPoint()));
      if (std::isnan(value)) continue;
      const double slack = 1e-9 * (1 + std::abs(value));  // rounding of the evaluation at the point
      ASSERT_TRUE(range.low - slack <= value && value <= range.high + slack)
          << value << " outside [" << range.low << ", " << range.high << "]";
    }
  }
}

TEST_F(ExpressionTest, EvaluatesEveryOperator) {
  EXPECT_EQ(At(Min(x_, y_) + Max(x_, y_) * 10, 2, 3), 32);
  EXPECT_EQ(At(Abs(x_) / y_, -6, 3), 2);
  EXPECT_EQ(At(Power(x_, -2), 2, 0), 0.25);
  EXPECT_EQ(At(Sqrt(y_) - x_, 1, 9), 2);
  EXPECT_EQ(At(Sin(x_) + Cos(y_), 1, 2), std::sin(1.0) + std::cos(2.0));
  EXPECT_EQ(At(7, 0, 0), 7);
}

}  // namespace
}  // namespace assay::algebra::expression_test
