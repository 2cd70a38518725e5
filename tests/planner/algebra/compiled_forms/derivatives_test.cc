#include "planner/algebra/compiled_forms/derivatives.h"
#include "planner/algebra/compiled_forms/compiler.h"
#include "planner/algebra/normal_forms/normalization.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "planner/algebra/bounding_methods/centred.h"
#include "planner/algebra/bounding_methods/monotone.h"
#include "planner/algebra/bounds/probe.h"
#include "planner/numeric/interval_arithmetic.h"
#include "tests/oracle/random_expression.h"

namespace assay::algebra::derivatives_test {
namespace {

std::vector<VariableId> AllVariables(const ExpressionPool& pool) {
  std::vector<VariableId> variables;
  for (int i = 0; i < pool.variable_count(); ++i) variables.emplace_back(i);
  return variables;
}

Interval Single(double x) { return {x, x}; }

// A form, its box, and functions that evaluate it.
struct Sample {
  Sample(const Expression& e, const ExpressionPool& pool)
      : form(Compile(NormalFormOf(e), AllVariables(pool))), box(DeclaredBox(pool).box) {}

  std::vector<Interval> RandomPlace(RandomStream& random) const {
    std::vector<Interval> place;
    for (const Interval& x : box) place.push_back(Single(random.Uniform(x.low, x.high)));
    return place;
  }

  CompiledForm form;
  std::vector<Interval> box;
};

bool Meet(const Interval& a, const Interval& b) { return a.low <= b.high && b.low <= a.high; }

// Returns gradient * (b - a).
Interval Rise(const std::vector<Interval>& gradient, const std::vector<Interval>& a,
              const std::vector<Interval>& b) {
  Interval rise = {0, 0};
  for (std::size_t i = 0; i < a.size(); ++i) rise = rise + gradient[i] * (b[i] - a[i]);
  return rise;
}

TEST(Derivatives, OfAKnownForm) {
  ExpressionPool pool;
  const Expression x = pool.Declare("x", {0, 3});
  const Expression y = pool.Declare("y", {0, 3});
  const Sample sample(Power(x, 3) * y + Sin(x) + Sqrt(y), pool);
  Derivatives<double> at(sample.form);
  EXPECT_NEAR(at.Value(std::vector<double>{2, 1}), 9 + std::sin(2), 1e-12);
  EXPECT_NEAR(at.Gradient()[0], 12 + std::cos(2), 1e-12);
  EXPECT_NEAR(at.Gradient()[1], 8.5, 1e-12);
  EXPECT_NEAR(at.SecondDerivatives(0)[0], 12 - std::sin(2), 1e-12);
  EXPECT_NEAR(at.SecondDerivatives(0)[1], 12, 1e-12);
  EXPECT_NEAR(at.SecondDerivatives(1)[1], -0.25, 1e-12);
  EXPECT_FALSE(sample.form.affine[0]);
  EXPECT_FALSE(sample.form.affine[1]);
}

TEST(Derivatives, AffineVariablesAreThoseThatOnlyMultiply) {
  ExpressionPool pool;
  const Expression x = pool.Declare("x", {0, 3});
  const Expression y = pool.Declare("y", {0, 3});
  const Expression z = pool.Declare("z", {0, 3});
  const Sample sample(x * Cos(y) + x * z - Abs(z), pool);
  EXPECT_EQ(sample.form.affine, (std::vector<bool>{true, false, false}));
}

// Mean value theorem: the difference of the form at two points is bounded by the slopes between
// them.
TEST(Derivatives, OverABoxExplainEveryRise) {
  RandomStream random(1, "rise");
  int compared = 0;
  for (int i = 0; i < 3000; ++i) {
    ExpressionPool pool;
    const Expression e = oracle::RandomExpressionAndBox(5, random, pool);
    const Sample sample(e, pool);
    Derivatives<Interval> over(sample.form);
    const Interval range = over.Value(sample.box);
    if (!over.DefinedEverywhere()) continue;
    const std::vector<Interval> gradient = over.Gradient();
    for (int k = 0; k < 5; ++k) {
      const auto a = sample.RandomPlace(random), b = sample.RandomPlace(random);
      const Interval at_a = over.Value(a), at_b = over.Value(b);
      EXPECT_TRUE(Meet(range, at_a)) << i;
      EXPECT_TRUE(Meet(at_b - at_a, Rise(gradient, a, b))) << i;
      ++compared;
    }
  }
  EXPECT_GT(compared, 1000);
}

TEST(Derivatives, OfSecondOrderExplainEveryRiseOfTheFirst) {
  RandomStream random(2, "bend");
  int compared = 0;
  for (int i = 0; i < 3000; ++i) {
    ExpressionPool pool;
    const Expression e = oracle::RandomExpressionAndBox(5, random, pool);
    const Sample sample(e, pool);
    Derivatives<Interval> over(sample.form);
    over.Value(sample.box);
    if (!over.DefinedEverywhere()) continue;
    over.Gradient();
    const int variable = random.Index(pool.variable_count());
    const std::vector<Interval> row = over.SecondDerivatives(variable);
    const auto a = sample.RandomPlace(random), b = sample.RandomPlace(random);
    over.Value(a);
    const Interval at_a = over.Gradient()[variable];
    over.Value(b);
    const Interval at_b = over.Gradient()[variable];
    EXPECT_TRUE(Meet(at_b - at_a, Rise(row, a, b))) << i;
    ++compared;
  }
  EXPECT_GT(compared, 200);
}

TEST(Derivatives, KnowWhereThereIsNoValue) {
  ExpressionPool pool;
  const Expression x = pool.Declare("x", {-1, 1});
  const Sample root(Sqrt(x), pool);
  Derivatives<Interval> over(root.form);
  over.Value(root.box);
  EXPECT_FALSE(over.DefinedEverywhere());
  EXPECT_TRUE(over.DefinedSomewhere());
  EXPECT_EQ(over.Gradient()[0], kWholeLine);
  over.Value(std::vector<Interval>{{-1, -0.5}});
  EXPECT_FALSE(over.DefinedSomewhere());
  over.Value(std::vector<Interval>{{0.25, 1}});
  EXPECT_TRUE(over.DefinedEverywhere());
}

// ---- Uses of derivatives by the bounding methods ----

TEST(MonotoneVariables, AreSetOneAfterAnother) {
  ExpressionPool pool;
  const Expression x = pool.Declare("x", {-1, 2});
  const Expression y = pool.Declare("y", {1, 2});
  // The expression increases in x because y > 0. It increases in y only where x is 2.
  const Maximization problem = MaximizationOf(x * y, 1, DeclaredBox(pool));
  Probe probe(problem);
  const MonotoneBox monotone = SetMonotoneVariables(probe, problem.box);
  EXPECT_EQ(monotone.box, (Box{{2, 2}, {2, 2}}));
  const MonotoneBox held = SetMonotoneVariables(probe, problem.box, {true, false});
  EXPECT_EQ(held.box, problem.box);
}

bool IsConcaveInAll(const Expression& e, const ExpressionPool& pool) {
  const Maximization problem = MaximizationOf(e, 1, DeclaredBox(pool));
  Probe probe(problem);
  probe.Range(problem.box);
  probe.GradientOverBox();
  std::vector<int> variables;
  for (std::size_t i = 0; i < problem.variables.size(); ++i) {
    variables.push_back(static_cast<int>(i));
  }
  return IsConcave(probe, variables);
}

TEST(Concavity, IsSeenWhereItHoldsAllOver) {
  ExpressionPool pool;
  const Expression x = pool.Declare("x", {-1, 1});
  const Expression y = pool.Declare("y", {-1, 1});
  EXPECT_TRUE(IsConcaveInAll(x * y - Power(x, 2) - Power(y, 2), pool));
  EXPECT_FALSE(IsConcaveInAll(3 * x * y - Power(x, 2) - Power(y, 2), pool));
  EXPECT_FALSE(IsConcaveInAll(x * y, pool));
  EXPECT_FALSE(IsConcaveInAll(Cos(x) * Cos(y), pool));
  EXPECT_TRUE(IsConcaveInAll(Cos(x / 2) + Cos(y / 2), pool));
  EXPECT_FALSE(IsConcaveInAll(-Abs(x) - Power(y, 2), pool));
}

}  // namespace
}  // namespace assay::algebra::derivatives_test
