#include "planner/algebra/bounding_methods/first_order.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/algebra/bounds/bounds.h"
#include "planner/algebra/sup_inf/sup_inf.h"
#include "planner/numeric/interval_arithmetic.h"
#include "tests/oracle/dense_search.h"
#include "tests/oracle/random_expression.h"

namespace assay::algebra::first_order_test {
namespace {

using oracle::ValueAt;

TEST(FirstOrder, OfALinearExpressionIsExact) {
  ExpressionPool pool;
  const Expression x = pool.Declare("x", {-1, 1});
  const Expression y = pool.Declare("y", {0, 2});
  const std::vector<Interval> box = DeclaredBox(pool).box;
  FirstOrderForms forms;
  const Glance above = forms.Above(3 * x - 2 * y + 1, box, -kInfinity);
  EXPECT_NEAR(above.bound, 4, 1e-12);
  EXPECT_NEAR(above.attained, 4, 1e-12);
  const Glance below = forms.Below(3 * x - 2 * y + 1, box, kInfinity);
  EXPECT_NEAR(below.bound, -6, 1e-12);
  EXPECT_NEAR(below.attained, -6, 1e-12);
}

// Terms that cancel to first order do so however the expression is written.
TEST(FirstOrder, LeavesOnlyCurvature) {
  for (const double width : {0.1, 0.01}) {
    ExpressionPool pool;
    const Expression a = pool.Declare("a", {-width, width});
    const Expression b = pool.Declare("b", {-width, width});
    const Expression e = Sin(a) * Cos(b) + Cos(a) * Sin(b) - a - b;
    FirstOrderForms forms;
    EXPECT_LT(forms.Above(e, DeclaredBox(pool).box, -kInfinity).bound, 8 * width * width);
    EXPECT_GT(forms.Below(e, DeclaredBox(pool).box, kInfinity).bound, -8 * width * width);
  }
}

// Over [-r, r], the contribution of x^2 has one sign.
TEST(FirstOrder, KnowsThatSquaresAreNotNegative) {
  ExpressionPool pool;
  const Expression x = pool.Declare("x", {-0.5, 0.5});
  FirstOrderForms forms;
  EXPECT_NEAR(forms.Below(Power(x, 2), DeclaredBox(pool).box, kInfinity).bound, 0, 1e-12);
  EXPECT_NEAR(forms.Above(Power(x, 2), DeclaredBox(pool).box, -kInfinity).bound, 0.25, 1e-12);
}

TEST(FirstOrder, TellsNothingOfWhatItDoesNotKnow) {
  ExpressionPool pool;
  const Expression x = pool.Declare("x", {1, 2});
  FirstOrderForms forms;
  for (const Expression& e : {Sqrt(x), 1 / x, Abs(x), Power(x, -1), Min(x, 2 * x)}) {
    const Glance glance = forms.Above(x + e, DeclaredBox(pool).box, -kInfinity);
    EXPECT_EQ(glance.bound, kInfinity);
    EXPECT_EQ(glance.attained, -kInfinity);
  }
}

// No value is beyond the bound, and the extremum is at least the attained value.
TEST(FirstOrder, HoldsForRandomExpressions) {
  RandomStream random(31, "first order");
  int told = 0;
  int answered = 0;
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    ExpressionPool pool;
    const Expression e = oracle::RandomExpressionAndBox(6, random, pool);
    const ConstraintSet box = DeclaredBox(pool);
    FirstOrderForms forms;
    const Glance above = forms.Above(e, box.box, -kInfinity);
    const Glance below = forms.Below(e, box.box, kInfinity);
    if (!std::isfinite(above.bound)) continue;
    ++told;
    for (int k = 0; k < 20; ++k) {
      const Interval value = ValueAt(e, oracle::RandomPoint(box.box, random));
      if (std::isnan(value.low) || std::isnan(value.high)) continue;
      EXPECT_LE(value.low, above.bound);
      EXPECT_GE(value.high, below.bound);
    }
    const BoundRequest request = {.evaluations = 1000};
    EXPECT_LE(above.attained, BoundAbove(e, box, request).value);
    EXPECT_GE(below.attained, BoundBelow(e, box, request).value);
    // A limit between attained value and bound makes the method evaluate a corner. The attained
    // value then grows but never exceeds the true extremum.
    const double limit = (above.bound + above.attained) / 2;
    const Glance asked = forms.Above(e, box.box, limit);
    EXPECT_EQ(asked.bound, above.bound);
    EXPECT_GE(asked.attained, above.attained);
    EXPECT_LE(asked.attained, BoundAbove(e, box, request).value);
    EXPECT_LE(forms.Below(e, box.box, (below.bound + below.attained) / 2).attained, below.attained);
    answered += asked.attained >= limit ? 1 : 0;
  }
  EXPECT_GT(told, 100);
  EXPECT_GT(answered, told / 4);
}

// The answer does not depend on the order of the requests or on other expressions.
TEST(FirstOrder, IsTheSameForOneAsForOneOfMany) {
  RandomStream random(32, "first order of many");
  ExpressionPool pool;
  const Expression a = pool.Declare("a", {-0.1, 0.2});
  const Expression b = pool.Declare("b", {0.5, 0.6});
  const std::vector<Expression> many = {a * b, Sin(a * b) + a, Cos(b) * Sin(a * b),
                                        Power(Cos(b), 3) - a * b, a + b};
  const std::vector<Interval> box = DeclaredBox(pool).box;
  FirstOrderForms together;
  for (int i = 0; i < 20; ++i) {
    const Expression& e = many[random.Index(static_cast<int>(many.size()))];
    FirstOrderForms alone;
    EXPECT_EQ(together.Above(e, box, -kInfinity).bound, alone.Above(e, box, -kInfinity).bound);
    EXPECT_EQ(together.Below(e, box, kInfinity).attained, alone.Below(e, box, kInfinity).attained);
  }
}

}  // namespace
}  // namespace assay::algebra::first_order_test
