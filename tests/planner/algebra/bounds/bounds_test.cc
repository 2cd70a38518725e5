#include "planner/algebra/bounds/bounds.h"
#include "planner/algebra/expression/evaluation.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bench/workloads/measured_expressions.h"
#include "bench/workloads/transform_chains.h"
#include "planner/algebra/sup_inf/sup_inf.h"
#include "planner/numeric/interval_arithmetic.h"
#include "tests/oracle/dense_search.h"
#include "tests/oracle/random_expression.h"

namespace assay::algebra::bounds_test {
namespace {

using oracle::ValueAt;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kRounding = 1e-14;  // rounding of a few operations on numbers near 1
constexpr BoundingMethod kBoundingMethods[] = {BoundingMethod::kTermwise, BoundingMethod::kMonotone,
                                               BoundingMethod::kCentred,
                                               BoundingMethod::kBranchAndBound};

BoundRequest UpTo(BoundingMethod highest) { return {.highest = highest}; }

Interval Range(const Expression& e, const ConstraintSet& constraints,
               const BoundRequest& request = {}) {
  return {BoundBelow(e, constraints, request).value, BoundAbove(e, constraints, request).value};
}

double DoubleAt(const Expression& e, const std::vector<double>& point) {
  return Evaluate(e, std::span<const double>(point));
}

// Expects that the fields of a bound are consistent. `sign` is 1 for SUP and -1 for INF.
void ExpectHonest(const Bound& bound, int sign, const Expression& e,
                  const ConstraintSet& constraints) {
  ASSERT_FALSE(std::isnan(bound.value));
  ASSERT_GE(bound.gap, 0);
  if (bound.at.empty()) {
    EXPECT_EQ(bound.gap, kInfinity);
    return;
  }
  ASSERT_EQ(bound.at.size(), constraints.box.size());
  for (std::size_t i = 0; i < bound.at.size(); ++i) {
    EXPECT_TRUE(Contains(constraints.box[i], bound.at[i]));
  }
  for (const Inequality& inequality : constraints.inequalities) {
    EXPECT_LE(DoubleAt(inequality.lesser, bound.at),
              DoubleAt(inequality.greater, bound.at) + 1e-12);
  }
  const Interval attained = ValueAt(e, bound.at);
  if (std::isinf(bound.value)) {
    EXPECT_EQ(bound.gap, kInfinity);
    return;
  }
  if (sign > 0) {
    EXPECT_LE(attained.low, bound.value);
    EXPECT_GE(attained.high, bound.value - bound.gap);
  } else {
    EXPECT_GE(attained.high, bound.value);
    EXPECT_LE(attained.low, bound.value + bound.gap);
  }
}

// ---- The worked example of Spar: known facts about its published expression ----

struct SparBounds {
  double theta = 5.5 * kDegree;
  double dx = 0.11;
};

// Returns y of contact point C1 or C2, seen from finger P1 (leading 2) or P2 (leading -2).
Expression FingerCoordinate(double leading, double contact_x, const SparBounds& bounds,
                            ExpressionPool& pool) {
  const double small = 0.001;
  const Expression tg = pool.Declare("tg", {-small * kDegree, small * kDegree});
  const Expression to = pool.Declare("to", {-bounds.theta, bounds.theta});
  const Expression dx = pool.Declare("dx", {-bounds.dx, bounds.dx});
  const Expression dy = pool.Declare("dy", {-0.11, 0.11});
  const Expression dxg = pool.Declare("dxg", {-small, small});
  const Expression dyg = pool.Declare("dyg", {-small, small});
  const Expression along = dx + contact_x * Cos(to) - Sin(to) - 1.5;
  const Expression across = dy + contact_x * Sin(to) + Cos(to) - 1;
  return leading + Cos(tg) * (along - dyg) + Sin(tg) * (dxg - across);
}

Interval TermwiseFingerRange(double leading, double contact_x, const SparBounds& bounds = {}) {
  ExpressionPool pool;
  const Expression e = FingerCoordinate(leading, contact_x, bounds, pool);
  return Range(e, DeclaredBox(pool), UpTo(BoundingMethod::kTermwise));
}

TEST(SparExample, TermwiseBoundsOfTheFourPreconditions) {
  const auto expect = [](const Interval& range, double low, double high) {
    EXPECT_NEAR(range.low, low, 5.1e-5);
    EXPECT_NEAR(range.high, high, 5.1e-5);
  };
  expect(TermwiseFingerRange(2, 3), 3.2793, 3.7069);
  expect(TermwiseFingerRange(2, 0), 0.2931, 0.7069);
  expect(TermwiseFingerRange(-2, 3), -0.7207, -0.2931);
  expect(TermwiseFingerRange(-2, 0), -3.7069, -3.2931);
}

TEST(SparExample, TermwiseIs3279301AndTheTruth3279336) {
  ExpressionPool pool;
  const Expression e = FingerCoordinate(2, 3, {}, pool);
  const Bound termwise = BoundBelow(e, DeclaredBox(pool), UpTo(BoundingMethod::kTermwise));
  EXPECT_NEAR(termwise.value, 3.279301, 5e-7);
  EXPECT_EQ(termwise.method, BoundingMethod::kTermwise);
  const Bound refined = BoundBelow(e, DeclaredBox(pool), {});
  EXPECT_NEAR(refined.value, 3.279336, 5e-7);
  EXPECT_LE(refined.gap, 1e-6);
}

bool AllFourAreProvable(const SparBounds& bounds) {
  return TermwiseFingerRange(2, 3, bounds).low > 0 && TermwiseFingerRange(2, 0, bounds).low > 0 &&
         TermwiseFingerRange(-2, 3, bounds).high < 0 && TermwiseFingerRange(-2, 0, bounds).high < 0;
}

TEST(SparExample, ProvableUpToTheStatedErrors) {
  EXPECT_TRUE(AllFourAreProvable({.theta = 22.8 * kDegree}));
  EXPECT_FALSE(AllFourAreProvable({.theta = 22.9 * kDegree}));
  EXPECT_TRUE(AllFourAreProvable({.dx = 0.403}));
  EXPECT_FALSE(AllFourAreProvable({.dx = 0.404}));
}

// ---- Each method on expressions for which it is made ----

TEST(Bounds, TermwiseIsExactForLinearExpressions) {
  ExpressionPool pool;
  const Expression x = pool.Declare("x", {-1, 2});
  const Expression y = pool.Declare("y", {0, 4});
  const Bound sup = BoundAbove(2 * x - y, DeclaredBox(pool), {});
  EXPECT_NEAR(sup.value, 4, kRounding);
  EXPECT_EQ(sup.method, BoundingMethod::kTermwise);
  EXPECT_LE(sup.gap, kRounding);
  EXPECT_EQ(sup.at, (std::vector<double>{2, 0}));
  EXPECT_NEAR(BoundBelow(2 * x - y, DeclaredBox(pool), {}).value, -6, kRounding);
}

TEST(Bounds, MonotoneSetsVariablesThatTermsShare) {
  ExpressionPool pool;
  const Expression x = pool.Declare("x", {1, 2});
  const Bound sup = BoundAbove(Power(x, 3) - x, DeclaredBox(pool), {});
  EXPECT_NEAR(sup.value, 6, 1e-12);
  EXPECT_EQ(sup.method, BoundingMethod::kMonotone);
  EXPECT_NEAR(BoundAbove(Power(x, 3) - x, DeclaredBox(pool), UpTo(BoundingMethod::kTermwise)).value,
              7, 1e-12);
}

TEST(Bounds, CentredIsTightWhereTheExpressionIsConcave) {
  ExpressionPool pool;
  const Expression x = pool.Declare("x", {-1, 2});
  const Expression y = pool.Declare("y", {-1, 2});
  const Expression e = x + y - Power(x, 2) - x * y - Power(y, 2);  // greatest at (1/3, 1/3)
  const Bound sup = BoundAbove(e, DeclaredBox(pool), {});
  EXPECT_NEAR(sup.value, 1.0 / 3, 1e-9);
  EXPECT_EQ(sup.method, BoundingMethod::kCentred);
}

TEST(Bounds, BranchAndBoundFindsTheHigherOfTwoHills) {
  ExpressionPool pool;
  const Expression x = pool.Declare("x", {0, 12});
  const Bound sup = BoundAbove(Sin(x) + x / 10, DeclaredBox(pool), {});
  EXPECT_EQ(sup.method, BoundingMethod::kBranchAndBound);
  // The greatest value is at x = 2 pi + acos(-1/10).
  const double top = 2 * std::numbers::pi + std::acos(-0.1);
  EXPECT_NEAR(sup.value, std::sin(top) + top / 10, 1e-6);
  EXPECT_LE(sup.gap, 1e-6);
}

TEST(Bounds, HigherRungsAreNeverLooser) {
  RandomStream random(3, "rungs");
  for (int links = 2; links <= 4; ++links) {
    ExpressionPool pool;
    const Expression e = workloads::PlanarChain(links, workloads::kWideErrors, random, pool);
    Interval previous = kWholeLine;
    for (BoundingMethod method : kBoundingMethods) {
      const Interval range = Range(e, DeclaredBox(pool), UpTo(method));
      EXPECT_GE(range.low, previous.low);
      EXPECT_LE(range.high, previous.high);
      previous = range;
    }
  }
}

// Rounding errors near the greatest value do not loosen the bound of the least value.
TEST(Bounds, LargeNumbersAreBoundedToTheGapWhereTheyAreSmall) {
  ExpressionPool pool;
  const Expression x = pool.Declare("x", {0, 1e6});
  const Expression y = pool.Declare("y", {0, 1e6});
  const Expression t = pool.Declare("t", {-0.1, 0.1});
  const Bound least = BoundBelow(x * y * Cos(t), DeclaredBox(pool), {.gap = 1e-6});
  EXPECT_GE(least.value, -1e-6);
  EXPECT_LE(least.value, 0);
  EXPECT_LE(least.gap, 1e-6);
}

TEST(Bounds, ANumberHasItselfForBounds) {
  ExpressionPool pool;
  EXPECT_EQ(Range(2.5, DeclaredBox(pool)), (Interval{2.5, 2.5}));
  EXPECT_EQ(Range(pool.Constant(0.1), DeclaredBox(pool)), (Interval{0.1, 0.1}));
}

TEST(Bounds, ALimitEndsTheSearchEarly) {
  RandomStream random(5, "limit");
  ExpressionPool pool;
  const Expression e = workloads::PlanarChain(4, workloads::kWideErrors, random, pool);
  const Bound full = BoundAbove(e, DeclaredBox(pool), {});
  const Bound proved = BoundAbove(e, DeclaredBox(pool), {.limit = full.value + 20});
  EXPECT_LT(proved.value, full.value + 20);
  EXPECT_LE(proved.evaluations, full.evaluations);
  const Bound refuted = BoundAbove(e, DeclaredBox(pool), {.limit = full.value - 20});
  EXPECT_GE(refuted.value - refuted.gap, full.value - 20);
  EXPECT_LE(refuted.evaluations, full.evaluations);
}

TEST(Bounds, AnExhaustedBudgetGivesAnHonestGap) {
  ExpressionPool pool;
  const Expression x = pool.Declare("x", {0, 3});
  const Expression y = pool.Declare("y", {0, 3});
  const Expression e = Sin(7 * x * y) * Cos(5 * x - y) - x / 7;
  const Bound sup = BoundAbove(e, DeclaredBox(pool), {.evaluations = 30});
  EXPECT_GT(sup.gap, 1e-6);
  ExpectHonest(sup, 1, e, DeclaredBox(pool));
  EXPECT_LE(sup.evaluations, 200);
}

// ---- No bounds, no values ----

TEST(Bounds, InfiniteIntervalsGiveInfiniteBoundsOrFiniteOnes) {
  ExpressionPool pool;
  const Expression x = pool.Declare("x", {0, kInfinity});
  const Expression y = pool.Declare("y", kWholeLine);
  const ConstraintSet box = DeclaredBox(pool);
  EXPECT_EQ(Range(x, box), (Interval{0, kInfinity}));
  EXPECT_EQ(Range(x - y, box), kWholeLine);
  EXPECT_EQ(Range(0 * y + 1, box), (Interval{1, 1}));
  EXPECT_NEAR(BoundBelow(x + Sin(y), box, {}).value, -1, kRounding);
  EXPECT_NEAR(BoundAbove(y - Power(y, 2), box, {}).value, 0.25, 1e-6);
}

TEST(Bounds, DivisionByAnIntervalThatHoldsZeroHasNoBound) {
  ExpressionPool pool;
  const Expression x = pool.Declare("x", {-1, 1});
  EXPECT_EQ(Range(1 / x, DeclaredBox(pool)), kWholeLine);
  EXPECT_EQ(BoundAbove(1 / x, DeclaredBox(pool), {}).gap, kInfinity);
  const Expression y = pool.Declare("y", {1, 2});
  EXPECT_NEAR(BoundAbove(x / y, DeclaredBox(pool), {}).value, 1, kRounding);
}

TEST(Bounds, RootsSpeakOfWhereTheyAreReal) {
  ExpressionPool pool;
  const Expression x = pool.Declare("x", {-4, 9});
  const Interval range = Range(Sqrt(x), DeclaredBox(pool));
  EXPECT_NEAR(range.low, 0, 1e-6);
  EXPECT_NEAR(range.high, 3, 1e-6);
  const Expression y = pool.Declare("y", {-2, -1});
  EXPECT_EQ(BoundAbove(Sqrt(y), DeclaredBox(pool), {}).at, std::vector<double>());
}

// ---- Inequalities ----

TEST(Bounds, LinearInequalitiesGiveTheLinearCore) {
  ExpressionPool pool;
  const Expression x = pool.Declare("x", {0, 10});
  const Expression y = pool.Declare("y", {0, 10});
  ConstraintSet constraints = DeclaredBox(pool);
  constraints.inequalities = {{x + 2 * y, 4}, {3 * x + y, 6}};
  const Bound sup = BoundAbove(x + y, constraints, {});
  EXPECT_NEAR(sup.value, 2.8, 1e-12);  // attained at (1.6, 1.2)
  EXPECT_EQ(sup.method, BoundingMethod::kLinear);
  EXPECT_LE(sup.gap, 1e-6);
  ExpectHonest(sup, 1, x + y, constraints);
}

TEST(Bounds, NonLinearInequalitiesArePruned) {
  ExpressionPool pool;
  const Expression x = pool.Declare("x", {-2, 2});
  const Expression y = pool.Declare("y", {-2, 2});
  ConstraintSet disc = DeclaredBox(pool);
  disc.inequalities = {{Power(x, 2) + Power(y, 2), 1}};
  const BoundRequest request = {.gap = 1e-3};
  const Bound sup = BoundAbove(x + y, disc, request);
  EXPECT_GE(sup.value, std::numbers::sqrt2);
  EXPECT_LE(sup.value, std::numbers::sqrt2 + 2e-3);
  EXPECT_LE(sup.gap, 1e-3);
  ExpectHonest(sup, 1, x + y, disc);
  const Bound inf = BoundBelow(x * y, disc, request);
  EXPECT_LE(inf.value, -0.5);
  EXPECT_GE(inf.value, -0.502);
  ExpectHonest(inf, -1, x * y, disc);
}

TEST(Bounds, InequalitiesThatContradictLeaveNothing) {
  ExpressionPool pool;
  const Expression x = pool.Declare("x", {-2, 2});
  const Expression y = pool.Declare("y", {-2, 2});
  ConstraintSet constraints = DeclaredBox(pool);
  constraints.inequalities = {{Power(x, 2) + Power(y, 2), -1}};
  const Bound sup = BoundAbove(x + y, constraints, {});
  EXPECT_EQ(sup.value, -kInfinity);
  EXPECT_TRUE(sup.at.empty());
}

TEST(Bounds, RandomInequalitiesAgainstDenseSearch) {
  RandomStream random(11, "constrained");
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    ExpressionPool pool;
    const Expression x = pool.Declare("x", {-1, 2});
    const Expression y = pool.Declare("y", {-2, 1});
    const auto number = [&] { return Expression(random.Uniform(-2, 2)); };
    const Expression e = number() * x * y + number() * Sin(x) + number() * Power(y, 2);
    ConstraintSet constraints = DeclaredBox(pool);
    constraints.inequalities = {{number() * x + number() * y, number()},
                                {number() * x * y, number() + y}};
    const oracle::Function f = [&](const std::vector<double>& point) {
      for (const Inequality& inequality : constraints.inequalities) {
        if (DoubleAt(inequality.lesser, point) > DoubleAt(inequality.greater, point)) {
          return std::numeric_limits<double>::quiet_NaN();
        }
      }
      return DoubleAt(e, point);
    };
    const oracle::Found found = oracle::GreatestByDenseSearch(f, constraints.box, random);
    const Bound sup = BoundAbove(e, constraints, {.gap = 1e-3, .evaluations = 5'000});
    EXPECT_GE(sup.value, found.value - 1e-12);
    ExpectHonest(sup, 1, e, constraints);
  }
}

// ---- Against references ----

TEST(Bounds, ChainsAgainstDenseSearch) {
  RandomStream random(7, "chains");
  const auto check = [&](const Expression& e, const ExpressionPool& pool) {
    const ConstraintSet box = DeclaredBox(pool);
    const Bound sup = BoundAbove(e, box, {});
    const Bound inf = BoundBelow(e, box, {});
    EXPECT_LE(sup.gap, 1e-6);
    EXPECT_LE(inf.gap, 1e-6);
    ExpectHonest(sup, 1, e, box);
    ExpectHonest(inf, -1, e, box);
    const oracle::DenseSearch effort = {.starts = 100, .improved = 10, .most_steps = 150};
    const auto value = [&](const std::vector<double>& point) { return DoubleAt(e, point); };
    const auto minus = [&](const std::vector<double>& point) { return -DoubleAt(e, point); };
    const double most = GreatestByDenseSearch(value, box.box, random, effort).value;
    const double least = -GreatestByDenseSearch(minus, box.box, random, effort).value;
    EXPECT_GE(sup.value, most - 1e-12);
    EXPECT_LE(inf.value, least + 1e-12);
    EXPECT_LE(sup.value, most + 1e-4);
    EXPECT_GE(inf.value, least - 1e-4);
  };
  for (const workloads::ErrorBounds& errors :
       {workloads::ErrorBounds(), workloads::kWideErrors, workloads::kArmErrors}) {
    for (int links = 1; links <= 3; ++links) {
      ExpressionPool planar, spatial;
      check(workloads::PlanarChain(links, errors, random, planar), planar);
      check(workloads::SpatialChain(links, errors, random, spatial), spatial);
    }
  }
}

TEST(Bounds, CancellingChainsKeepOnlyTheExtraDisplacement) {
  RandomStream random(9, "cancelling");
  for (int links = 1; links <= 2; ++links) {
    ExpressionPool pool;
    const Expression e = workloads::CancellingChain(links, workloads::ErrorBounds(), random, pool);
    EXPECT_NEAR(Width(Range(e, DeclaredBox(pool))), 0.22, 1e-9) << links;
  }
}

TEST(Bounds, ManyLongTermsTakeFewEvaluations) {
  RandomStream random(13, "terms");
  ExpressionPool pool;
  std::vector<Expression> variables;
  for (int i = 0; i < 150; ++i) variables.push_back(pool.Declare(fmt::format("v{}", i), {0.5, 1}));
  Expression sum = 0;
  double at_ones = 0;
  for (int i = 0; i < 150; ++i) {
    Expression product = 1.0 + i;
    for (int k = 1 + random.Index(50); k > 0; --k) product = product * variables[random.Index(150)];
    sum = sum + product;
    at_ones += 1.0 + i;
  }
  const Bound sup = BoundAbove(sum, DeclaredBox(pool), {});
  EXPECT_NEAR(sup.value, at_ones, 1e-6);
  EXPECT_GE(sup.value, at_ones);
  EXPECT_LE(sup.evaluations, 10);
}

// ---- Prepared expressions ----

void ExpectSame(const Bound& a, const Bound& b) {
  EXPECT_EQ(a.value, b.value);
  EXPECT_EQ(a.gap, b.gap);
  EXPECT_EQ(a.at, b.at);
  EXPECT_EQ(a.method, b.method);
  EXPECT_EQ(a.evaluations, b.evaluations);
}

ConstraintSet RandomBox(double widest, RandomStream& random, const ExpressionPool& pool) {
  ConstraintSet constraints = DeclaredBox(pool);
  for (Interval& x : constraints.box) {
    const double low = random.Uniform(-0.5, 0.5);
    x = {low, low + random.Uniform(0, widest)};
  }
  return constraints;
}

// The bound of an expression does not depend on earlier requests.
TEST(PreparedExpression, AnswersAsIfAskedForTheFirstTime) {
  RandomStream random(19, "prepared");
  for (const bool is_chain : {true, false}) {
    ExpressionPool pool;
    const Expression chain = workloads::PlanarChain(3, workloads::kWideErrors, random, pool);
    const Expression e = is_chain ? chain : chain * chain;
    PreparedExpression prepared(e);
    for (int i = 0; i < 10; ++i) {
      const ConstraintSet box = RandomBox(0.4, random, pool);
      const BoundRequest request = {.evaluations = 100};
      const BothBounds both = prepared.Both(box, request);
      ExpectSame(both.inf, BoundBelow(e, box, request));
      ExpectSame(both.sup, BoundAbove(e, box, request));
      ExpectSame(both.sup, prepared.Above(box, request));
      ExpectSame(both.inf, prepared.Below(box, request));
    }
  }
}

// A constraint that always holds makes BoundAbove and BoundBelow use other methods than the
// multi-affine form, so that both ways can be compared.
TEST(PreparedExpression, OfAMultiaffineFormAgreesWithTheLadder) {
  RandomStream random(23, "agrees");
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    ExpressionPool pool;
    const bool is_planar = i % 2 == 0;
    const Expression e =
        is_planar ? workloads::PlanarChain(1 + i % 3, workloads::kWideErrors, random, pool)
                  : workloads::SpatialChain(1 + i % 3, workloads::kWideErrors, random, pool);
    ConstraintSet box = RandomBox(i % 4 < 2 ? 0.3 : 1.2, random, pool);
    const BothBounds both = PreparedExpression(e).Both(box, {});
    ExpectHonest(both.sup, 1, e, box);
    ExpectHonest(both.inf, -1, e, box);
    EXPECT_LE(both.sup.gap, 1e-6);
    EXPECT_LE(both.inf.gap, 1e-6);
    box.inequalities = {{pool.Variable(VariableId(0)), 100}};
    const Bound sup = BoundAbove(e, box, {.gap = 1e-2, .evaluations = 200});
    const Bound inf = BoundBelow(e, box, {.gap = 1e-2, .evaluations = 200});
    EXPECT_LE(both.sup.value, sup.value + 1e-6);
    EXPECT_GE(both.sup.value, sup.value - sup.gap);
    EXPECT_GE(both.inf.value, inf.value - 1e-6);
    EXPECT_LE(both.inf.value, inf.value + inf.gap);
  }
}

// The boxes have angles of all sizes, beyond whole turns, ends that are equal, and ends that are
// far away.
TEST(PreparedExpression, OfAMultiaffineFormOverAnyBox) {
  RandomStream random(29, "any box");
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    ExpressionPool pool;
    const Expression e = workloads::PlanarChain(2, workloads::kWideErrors, random, pool);
    ConstraintSet box = DeclaredBox(pool);
    for (Interval& x : box.box) {
      const double low = random.Uniform(-1, 1) * (random.Index(4) == 0 ? 1e3 : 4);
      x = {low, random.Index(4) == 0 ? low : low + random.Uniform(0, 8)};
    }
    const BothBounds both = PreparedExpression(e).Both(box, {.gap = 1e-3, .evaluations = 2'000});
    ExpectHonest(both.sup, 1, e, box);
    ExpectHonest(both.inf, -1, e, box);
    for (int sample = 0; sample < 50; ++sample) {
      std::vector<double> point;
      for (const Interval& x : box.box) {
        point.push_back(random.Index(3) == 0 ? x.low : random.Uniform(x.low, x.high));
      }
      EXPECT_LE(ValueAt(e, point).low, both.sup.value);
      EXPECT_GE(ValueAt(e, point).high, both.inf.value);
    }
  }
}

TEST(PreparedExpression, InfiniteBoxesAreLeftToTheLadder) {
  ExpressionPool pool;
  const Expression x = pool.Declare("x", {0, kInfinity});
  const Expression t = pool.Declare("t", {0, 1});
  const BothBounds both = PreparedExpression(x + Cos(t)).Both(DeclaredBox(pool), {});
  EXPECT_NEAR(both.inf.value, std::cos(1), 1e-9);
  EXPECT_EQ(both.sup.value, kInfinity);
}

TEST(PreparedExpression, HasTheKnownRangesOfMeasuredExpressions) {
  for (const workloads::MeasuredExpression& measured :
       workloads::LoadMeasuredExpressions(ASSAY_SOURCE_DIR "/bench/workloads/expressions")) {
    SCOPED_TRACE(measured.name);
    const ConstraintSet& box = measured.problem.constraints;
    const BothBounds both = PreparedExpression(measured.expression()).Both(box, {});
    EXPECT_NEAR(both.inf.value, measured.range.low, 1e-6);
    EXPECT_NEAR(both.sup.value, measured.range.high, 1e-6);
    EXPECT_LE(std::max(both.inf.gap, both.sup.gap), 1e-6);
    ExpectHonest(both.sup, 1, measured.expression(), box);
    ExpectHonest(both.inf, -1, measured.expression(), box);
    const bool cancels = measured.name.starts_with("cancel");
    EXPECT_TRUE(!cancels || both.inf.splits + both.sup.splits == 0);
  }
}

class RandomExpressions : public testing::TestWithParam<BoundingMethod> {};
INSTANTIATE_TEST_SUITE_P(EachRung, RandomExpressions, testing::ValuesIn(kBoundingMethods),
                         [](const auto& instance) {
                           std::string name(Name(instance.param));
                           std::erase(name, '-');
                           return name;
                         });

// No value of an expression, sampled or found by ascent, lies outside the bounds of any method. The
// four parts of this test have 10,000 expressions together.
TEST_P(RandomExpressions, HaveNoValueOutsideTheirBounds) {
  RandomStream random(17, Name(GetParam()));
  for (int i = 0; i < 2500; ++i) {
    SCOPED_TRACE(i);
    ExpressionPool pool;
    const Expression e = oracle::RandomExpressionAndBox(8, random, pool);
    const ConstraintSet box = DeclaredBox(pool);
    const BoundRequest request = {.highest = GetParam(), .gap = 1e-3, .evaluations = 100};
    const Bound sup = BoundAbove(e, box, request);
    const Bound inf = BoundBelow(e, box, request);
    ExpectHonest(sup, 1, e, box);
    ExpectHonest(inf, -1, e, box);
    const auto check = [&](const std::vector<double>& point) {
      const double value = DoubleAt(e, point);
      if (std::isnan(value)) return value;
      const Interval certain = ValueAt(e, point);
      EXPECT_LE(certain.low, sup.value);
      EXPECT_GE(certain.high, inf.value);
      return value;
    };
    const auto minus = [&](const std::vector<double>& point) { return -check(point); };
    const oracle::DenseSearch effort = {.starts = 10, .improved = 1, .most_steps = 5};
    oracle::GreatestByDenseSearch(check, box.box, random, effort);
    oracle::GreatestByDenseSearch(minus, box.box, random, effort);
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace assay::algebra::bounds_test
