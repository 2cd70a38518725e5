#include "planner/algebra/normal_forms/normal_form.h"
#include "planner/algebra/expression/evaluation.h"
#include "planner/algebra/normal_forms/normalization.h"
#include "planner/algebra/normal_forms/sum_writer.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "planner/algebra/expression/simplify.h"
#include "planner/algebra/expression/text.h"
#include "planner/numeric/interval_arithmetic.h"
#include "tests/oracle/random_expression.h"
#include "tests/planner/algebra/random_expression.h"

namespace assay::algebra::normal_form_test {
namespace {

class NormalFormTest : public testing::Test {
 protected:
  ExpressionPool pool_;
  Expression x_ = pool_.Declare("x", {-1, 2});
  Expression y_ = pool_.Declare("y", {0, 3});
  Expression z_ = pool_.Declare("z", {0, 3});
};

using Term = NormalForm::Term;

TEST_F(NormalFormTest, IsASumOfProductsOfPowersInOrder) {
  const NormalForm form = NormalFormOf(Power(x_ + y_, 2) + 3);
  const std::vector<Term> expected = {
      {.coefficient = {3, 3}, .factors = {}},
      {.coefficient = {2, 2}, .factors = {{x_, 1}, {y_, 1}}},
      {.coefficient = {1, 1}, .factors = {{x_, 2}}},
      {.coefficient = {1, 1}, .factors = {{y_, 2}}},
  };
  EXPECT_EQ(form.terms, expected);
  EXPECT_TRUE(NormalFormOf(x_ - x_).terms.empty());
  EXPECT_TRUE(NormalFormOf(0).terms.empty());
}

TEST_F(NormalFormTest, WhatIsExactStaysSingleAndWhatIsNotIsHeld) {
  for (const Term& term : NormalFormOf((2 * x_ + 0.25) * (y_ - 0.5)).terms) {
    EXPECT_TRUE(IsSingle(term.coefficient));
  }
  const NormalForm sum = NormalFormOf(0.1 * x_ + 0.2 * x_);
  ASSERT_EQ(sum.terms.size(), 1U);
  EXPECT_FALSE(IsSingle(sum.terms[0].coefficient));
  EXPECT_LT(Width(sum.terms[0].coefficient), 1e-16);
  const long double exact = static_cast<long double>(0.1) + 0.2;
  EXPECT_LE(sum.terms[0].coefficient.low, exact);
  EXPECT_GE(sum.terms[0].coefficient.high, exact);
}

TEST_F(NormalFormTest, FunctionsOfNumbersAreTightNumbers) {
  const NormalForm form = NormalFormOf(Sin(pool_.Constant(0.5)) * Sqrt(pool_.Constant(2)) * x_);
  ASSERT_EQ(form.terms.size(), 1U);
  EXPECT_TRUE(Contains(form.terms[0].coefficient, std::sin(0.5) * std::sqrt(2.0)));
  // The error is at most 16 machine epsilons: eight for the sine, four for the root, and four for
  // their product.
  EXPECT_LT(Width(form.terms[0].coefficient), 16 * std::numeric_limits<double>::epsilon());
}

TEST_F(NormalFormTest, ReciprocalsDoNotCancel) {
  const NormalForm form = NormalFormOf(x_ / x_);
  ASSERT_EQ(form.terms.size(), 1U);
  EXPECT_EQ(form.terms[0].factors, (std::vector<NormalForm::Factor>{{x_, 1}, {Power(x_, -1), 1}}));
  const std::vector<Interval> box(3, Interval{-1, 1});
  EXPECT_EQ(Evaluate(ToExpression(form), std::span<const Interval>(box)), kWholeLine);
  EXPECT_EQ(NormalFormOf(Power(x_ * y_, -2)), NormalFormOf(1 / (x_ * x_) / y_ / y_));
  EXPECT_EQ(NormalFormOf(x_ / 4), NormalFormOf(0.25 * x_));
  // 1 / 0 is kept as it is.
  EXPECT_EQ(NormalFormOf(x_ / pool_.Constant(0)).terms[0].factors.size(), 2U);
  EXPECT_EQ(NormalFormOf(1 / (x_ - x_)), NormalFormOf(pool_.Constant(1) / 0));
}

TEST_F(NormalFormTest, ArgumentsAreSimplifiedOnlyExactly) {
  EXPECT_EQ(NormalFormOf(Sin(2 * x_ + 3 * x_)), NormalFormOf(Sin(5 * x_)));
  const Expression rounded = Sin(0.1 * x_ + 0.2 * x_);
  EXPECT_EQ(NormalFormOf(rounded).terms[0].factors[0].atom, rounded);
  EXPECT_EQ(NormalFormOf(rounded, 20'000, AtomArguments::kRounded).terms[0].factors[0].atom,
            Sin((0.1 + 0.2) * x_));
}

// Returns the value of the normal form over the box of the point. It must contain the value of the
// expression.
Interval ValueOf(const NormalForm& form, std::span<const Interval> point) {
  Interval sum = {0, 0};
  for (const Term& term : form.terms) {
    Interval product = term.coefficient;
    for (const NormalForm::Factor& factor : term.factors) {
      product = product * Power(Evaluate(factor.atom, point), factor.exponent);
    }
    sum = sum + product;
  }
  return sum;
}

TEST_F(NormalFormTest, HoldsTheValueOfRandomExpressions) {
  RandomStream random(1, "normal form");
  int compared = 0;
  for (int i = 0; i < 1'000; ++i) {
    RandomExpressions expressions(random, 3);
    const Expression e = expressions.Draw(6);
    const NormalForm form = NormalFormOf(e, 300);
    const std::vector<double> numbers = expressions.DrawPoint();
    if (std::isnan(Evaluate(e, std::span<const double>(numbers)))) continue;
    std::vector<Interval> point;
    for (const double x : numbers) point.push_back({x, x});
    const Interval direct = Evaluate(e, std::span<const Interval>(point));
    const Interval through_form = ValueOf(form, point);
    // Both intervals contain the true value.
    EXPECT_LE(direct.low, through_form.high);
    EXPECT_GE(direct.high, through_form.low);
    ++compared;
  }
  EXPECT_GT(compared, 500);
}

TEST_F(NormalFormTest, ExpandsWithinItsLimit) {
  const Expression product = (x_ + y_ + 1) * (x_ + z_ + 2) * (y_ + z_ + 3);
  EXPECT_GT(NormalFormOf(product).terms.size(), 10U);
  const NormalForm kept = NormalFormOf(product, 10);
  ASSERT_EQ(kept.terms.size(), 1U);
  EXPECT_EQ(kept.terms[0].factors.size(), 3U);
  for (const NormalForm::Factor& factor : kept.terms[0].factors) {
    EXPECT_EQ(factor.atom.op(), Operator::kSum);
  }
  const NormalForm power = NormalFormOf(5 * Power(x_ + y_ + z_, 90), 100);
  ASSERT_EQ(power.terms.size(), 1U);
  EXPECT_EQ(power.terms[0].factors[0].exponent, 90);
}

TEST_F(NormalFormTest, LargeProductsAreQuick) {
  RandomStream random(2, "large products");
  std::vector<Expression> v;
  for (int i = 0; i < 20; ++i) v.push_back(pool_.Declare(fmt::format("v{}", i), {-1, 1}));
  const auto draw_sum = [&] {
    std::vector<Expression> terms;
    for (int i = 0; i < 14; ++i) terms.push_back(v[random.Index(20)] * Sin(v[random.Index(20)]));
    return Sum(terms);
  };
  std::vector<Expression> products;
  for (int i = 0; i < 100; ++i) products.push_back(draw_sum() * draw_sum() * random.Uniform(1, 2));
  const auto begin = std::chrono::steady_clock::now();
  const NormalForm form = NormalFormOf(Sum(products));
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  EXPECT_GT(form.terms.size(), 5'000U);
  EXPECT_LT(seconds.count(), 1.0);
}

TEST_F(NormalFormTest, DepthCostsNoStack) {
  Expression deep = x_;
  for (int i = 0; i < 10'000; ++i) deep = Sin(deep) / 2 + y_;
  EXPECT_EQ(NormalFormOf(deep).terms.size(), 2U);
}

// In a pool that keeps normal forms, many expressions one after another have the same normal forms
// as each has alone.
TEST(KeptNormalForms, AreTheSame) {
  for (int seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    ExpressionPool plain;
    ExpressionPool keeping;
    KeepNormalForms(keeping);
    RandomStream random(seed, "kept normal forms");
    RandomStream same_random(seed, "kept normal forms");
    const Expression first = oracle::RandomExpressionAndBox(6, random, plain);
    const Expression same_first = oracle::RandomExpressionAndBox(6, same_random, keeping);
    const auto expect_same = [&](const Expression& e, const Expression& same) {
      EXPECT_EQ(Text(Simplify(e)), Text(Simplify(same)));
      EXPECT_EQ(Text(ToExpression(NormalFormOf(e))), Text(ToExpression(NormalFormOf(same))));
    };
    expect_same(first, same_first);
    expect_same(Power(first, 2), Power(same_first, 2));
    expect_same(Sin(first) * first, Sin(same_first) * same_first);
    expect_same(first, same_first);
  }
}

}  // namespace
}  // namespace assay::algebra::normal_form_test
