#include "planner/algebra/bounds/sensitivity.h"

#include <gtest/gtest.h>

namespace assay::algebra::sensitivity_test {
namespace {

class Sensitivity : public testing::Test {
 protected:
  ExpressionPool pool_;
  Expression x_ = pool_.Declare("x", {-1, 1});
  Expression y_ = pool_.Declare("y", {2, 6});
  Expression z_ = pool_.Declare("z", {3, 3});
};

TEST_F(Sensitivity, AShareOfALinearExpressionIsCoefficientTimesHalfWidth) {
  const Expression e = 3 * x_ - 5 * y_ + z_;
  for (const auto& shares :
       {SharesOfSup(e, DeclaredBox(pool_), {}), SharesOfInf(e, DeclaredBox(pool_), {})}) {
    ASSERT_EQ(shares.size(), 2u);
    EXPECT_EQ(shares[0].variable, y_.variable());
    EXPECT_NEAR(shares[0].cost, 10, 1e-12);
    EXPECT_EQ(shares[1].variable, x_.variable());
    EXPECT_NEAR(shares[1].cost, 3, 1e-12);
  }
}

TEST_F(Sensitivity, WhatCostsNothingIsLeftOut) {
  // The least value of x^2 is in the middle, so that INF does not depend on the width of x.
  const Expression e = Power(x_, 2) + y_;
  const auto shares = SharesOfInf(e, DeclaredBox(pool_), {});
  ASSERT_EQ(shares.size(), 1u);
  EXPECT_EQ(shares[0].variable, y_.variable());
  EXPECT_EQ(SharesOfSup(e, DeclaredBox(pool_), {}).size(), 2u);
}

TEST_F(Sensitivity, TighteningsAreAsMildAsTheyCanBe) {
  // SUP is 3 + 6 = 9. To bring it below 7.5, y needs a factor just below 0.25, or x one just below
  // 0.5.
  const Expression e = 3 * x_ + y_;
  const auto tightenings = TighteningsToBringSupBelow(7.5, e, DeclaredBox(pool_), {});
  ASSERT_EQ(tightenings.size(), 2u);
  EXPECT_EQ(tightenings[0].variable, x_.variable());
  EXPECT_EQ(tightenings[0].factor, 0.499);
  EXPECT_EQ(tightenings[1].variable, y_.variable());
  EXPECT_EQ(tightenings[1].factor, 0.249);
}

TEST_F(Sensitivity, OnlyVariablesThatCanDoItAloneAreNamed) {
  // INF is -3 + 2 = -1. To bring it above 0.5, x alone suffices (up to 2), and y alone does (up to
  // 1).
  const Expression e = 3 * x_ + y_;
  EXPECT_EQ(TighteningsToBringInfAbove(0.5, e, DeclaredBox(pool_), {}).size(), 2u);
  const auto only_x = TighteningsToBringInfAbove(1.5, e, DeclaredBox(pool_), {});
  ASSERT_EQ(only_x.size(), 1u);
  EXPECT_EQ(only_x[0].variable, x_.variable());
  EXPECT_EQ(only_x[0].factor, 0.166);  // 2 - 3 * factor > 1.5
  EXPECT_TRUE(TighteningsToBringInfAbove(2.5, e, DeclaredBox(pool_), {}).empty());
}

TEST_F(Sensitivity, NoneIsNeededWhereTheBoundHolds) {
  EXPECT_TRUE(TighteningsToBringSupBelow(8, x_ + y_, DeclaredBox(pool_), {}).empty());
}

}  // namespace
}  // namespace assay::algebra::sensitivity_test
