#include "planner/algebra/bounding_methods/glance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/algebra/bounds/bounds.h"
#include "planner/numeric/interval_arithmetic.h"
#include "tests/oracle/dense_search.h"
#include "tests/oracle/random_expression.h"

namespace assay::algebra::glance_test {
namespace {

using oracle::ValueAt;

TEST(Glance, SetsMonotoneVariables) {
  ExpressionPool pool;
  const Expression x = pool.Declare("x", {0, 1});
  const Expression e = x - Sin(x) / 2;  // increasing; interval arithmetic alone gives [-0.42, 1]
  const std::vector<Interval> box = DeclaredBox(pool).box;
  EXPECT_NEAR(GlanceAbove(e, box, 0).bound, 1 - std::sin(1) / 2, 1e-14);
  EXPECT_NEAR(GlanceAbove(e, box, 0).attained, 1 - std::sin(1) / 2, 1e-14);
  EXPECT_NEAR(GlanceBelow(e, box, 0).bound, 0, 1e-14);
}

TEST(Glance, LooksNoFurtherThanTheLimitAsks) {
  ExpressionPool pool;
  const Expression x = pool.Declare("x", {0, 1});
  const Expression e = x - Sin(x) / 2;
  const std::vector<Interval> box = DeclaredBox(pool).box;
  EXPECT_NEAR(GlanceAbove(e, box, 2).bound, 1, 1e-14);
  EXPECT_NEAR(GlanceBelow(e, box, -2).bound, -std::sin(1) / 2, 1e-14);
}

TEST(Glance, OfANumberIsTheNumber) {
  EXPECT_EQ(GlanceAbove(2.5, {}, 0).bound, 2.5);
  EXPECT_EQ(GlanceAbove(2.5, {}, 0).attained, 2.5);
  EXPECT_EQ(GlanceBelow(2.5, {}, 7).bound, 2.5);
}

// No value that was sampled or found by ascent is outside the bounds. The attained value is within
// the bounds of the full method.
TEST(Glance, HasNoValueOutsideItsBounds) {
  RandomStream random(23, "glance");
  for (int i = 0; i < 2500; ++i) {
    SCOPED_TRACE(i);
    ExpressionPool pool;
    const Expression e = oracle::RandomExpressionAndBox(8, random, pool);
    const ConstraintSet box = DeclaredBox(pool);
    const Glance above = GlanceAbove(e, box.box, -kInfinity);
    const Glance below = GlanceBelow(e, box.box, kInfinity);
    const BoundRequest request = {.gap = 1e-3, .evaluations = 100};
    EXPECT_LE(above.attained, BoundAbove(e, box, request).value);
    EXPECT_GE(below.attained, BoundBelow(e, box, request).value);
    const auto check = [&](const std::vector<double>& point) {
      const Interval certain = ValueAt(e, point);
      if (std::isnan(certain.low) || std::isnan(certain.high)) return certain.low;
      EXPECT_LE(certain.low, above.bound);
      EXPECT_GE(certain.high, below.bound);
      return certain.low;
    };
    const oracle::DenseSearch effort = {.starts = 10, .improved = 1, .most_steps = 5};
    oracle::GreatestByDenseSearch(check, box.box, random, effort);
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace assay::algebra::glance_test
