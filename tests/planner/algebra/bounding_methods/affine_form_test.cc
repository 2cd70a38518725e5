#include "planner/algebra/bounding_methods/affine_form.h"
#include "planner/algebra/expression/nodes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/algebra/sup_inf/sup_inf.h"
#include "planner/numeric/interval_arithmetic.h"
#include "tests/oracle/dense_search.h"
#include "tests/oracle/random_expression.h"

namespace assay::algebra::affine_form_test {
namespace {

using oracle::ValueAt;

TEST(AffineForm, OfALinearExpressionHasNoRest) {
  ExpressionPool pool;
  const Expression x = pool.Declare("x", {-1, 1});
  const Expression y = pool.Declare("y", {0, 2});
  const AffineForm form = AffineFormOf(3 * x - 2 * y + 1, DeclaredBox(pool).box, 0);
  EXPECT_EQ(VariablesOf(form.linear).size(), 2u);
  EXPECT_NEAR(form.rest.low, 1, 1e-14);
  EXPECT_NEAR(form.rest.high, 1, 1e-14);
}

TEST(AffineForm, PutsWhatIsNegligibleIntoTheRest) {
  ExpressionPool pool;
  const Expression x = pool.Declare("x", {-1, 1});
  const Expression y = pool.Declare("y", {-1, 1});
  const AffineForm form = AffineFormOf(x + 0.001 * y, DeclaredBox(pool).box, 0.01);
  EXPECT_EQ(VariablesOf(form.linear).size(), 1u);
  EXPECT_NEAR(form.rest.low, -0.001, 1e-15);
  EXPECT_NEAR(form.rest.high, 0.001, 1e-15);
}

// The remainder of a smooth expression shrinks with the square of the box's width.
TEST(AffineForm, LeavesOnlyCurvature) {
  for (const double width : {0.1, 0.01}) {
    ExpressionPool pool;
    const Expression a = pool.Declare("a", {-width, width});
    const Expression b = pool.Declare("b", {-width, width});
    const AffineForm form =
        AffineFormOf(Sin(a) * Cos(b) + a * b + Cos(a + b), DeclaredBox(pool).box, 0);
    EXPECT_LT(Width(form.rest), 16 * width * width);
  }
}

TEST(AffineForm, HoldsEveryValue) {
  RandomStream random(29, "affine form");
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    ExpressionPool pool;
    const Expression e = oracle::RandomExpressionAndBox(6, random, pool);
    const std::vector<Interval> box = DeclaredBox(pool).box;
    const AffineForm form = AffineFormOf(e, box, random.Index(2) == 0 ? 0 : 0.05);
    for (int k = 0; k < 20; ++k) {
      const std::vector<double> point = oracle::RandomPoint(box, random);
      const Interval value = ValueAt(e, point);
      if (std::isnan(value.low) || std::isnan(value.high)) continue;
      const Interval said = ValueAt(form.linear, point) + form.rest;
      EXPECT_LE(said.low, value.high);
      EXPECT_GE(said.high, value.low);
    }
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace assay::algebra::affine_form_test
