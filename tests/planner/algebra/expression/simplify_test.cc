#include "planner/algebra/expression/simplify.h"
#include "planner/algebra/expression/evaluation.h"
#include "planner/algebra/expression/parse.h"

#include <gtest/gtest.h>

#include <cmath>
#include <span>

#include "planner/algebra/expression/text.h"
#include "tests/planner/algebra/random_expression.h"

namespace assay::algebra::simplify_test {
namespace {

class SimplifyTest : public testing::Test {
 protected:
  Expression Read(std::string_view text) {
    return Parse(text, pool_, {.file = "test", .line = 1, .column = 1});
  }
  void ExpectSame(std::string_view a, std::string_view b) {
    EXPECT_EQ(Simplify(Read(a)), Simplify(Read(b))) << a << " gives " << Text(Simplify(Read(a)));
  }

  ExpressionPool pool_;
  Expression x_ = pool_.Declare("x", {-1, 2});
  Expression y_ = pool_.Declare("y", {0, 3});
  Expression z_ = pool_.Declare("z", {0, 3});
};

TEST_F(SimplifyTest, MultipliesOutAndMerges) {
  ExpectSame("(x + y)*(x - y)", "x^2 - y^2");
  ExpectSame("(x + y)^3 - 3*x*y*(x + y)", "y^3 + x^3");
  ExpectSame("x*(y*(z + 1) - z) - x*y*z", "x*y - z*x");
  ExpectSame("(x + 1)/4", "0.25*x + 0.25");
  EXPECT_EQ(Text(Simplify(Read("x + 2*x - 3*x + 5"))), "5");
}

TEST_F(SimplifyTest, SquaredSinesBecomeCosines) {
  ExpectSame("sin(x)^2 + cos(x)^2", "1");
  ExpectSame("sin(x)^4", "1 - 2*cos(x)^2 + cos(x)^4");
  ExpectSame("sin(x)^3*sin(y)", "sin(x)*sin(y) - sin(x)*sin(y)*cos(x)^2");
  ExpectSame("(sin(x)*sin(y))^2", "(1 - cos(x)^2)*(1 - cos(y)^2)");
  // This expression is the one in the `cancel` files of the benchmark.
  EXPECT_EQ(Text(Simplify(Read("3.2*cos(x)*cos(x) + 0.7*cos(x)*cos(x)*y + 3.2*sin(x)*sin(x) + "
                               "0.7*sin(x)*sin(x)*y"))),
            "3.2 + 0.7*y");
}

TEST_F(SimplifyTest, SignsLeaveArguments) {
  ExpectSame("sin(y - x)", "-sin(x - y)");
  ExpectSame("cos(y - x)", "cos(x - y)");
  ExpectSame("sin(-x)*cos(-x)", "-sin(x)*cos(x)");
  ExpectSame("abs(y - x)", "abs(x - y)");
  ExpectSame("1/(y - x) + 1/(x - y)", "0");
}

TEST_F(SimplifyTest, RootsAndSizesSquared) {
  ExpectSame("sqrt(x + y)^2", "x + y");
  ExpectSame("sqrt(x)^3", "x*sqrt(x)");
  ExpectSame("abs(x - y)^2", "x^2 - 2*x*y + y^2");
  ExpectSame("abs(x)*abs(-x)", "x^2");
  ExpectSame("min(x + y, y)", "min(y, y + x)");
  ExpectSame("max(x + y, y + x)", "x + y");
}

TEST_F(SimplifyTest, ReciprocalsStay) {
  EXPECT_NE(Simplify(Read("x/x")), Expression(1));
  EXPECT_EQ(Simplify(Read("1/0")).op(), Operator::kPower);
  ExpectSame("x/(2*y)", "0.5*x*y^-1");
}

TEST_F(SimplifyTest, RoundingAloneDoesNotStay) {
  EXPECT_EQ(Simplify(Read("0.1*x + 0.2*x - 0.3*x")), Expression(0));
  EXPECT_EQ(Simplify(Read("x*(cos(0.3)^2 + sin(0.3)^2 - 1)")), Expression(0));
}

TEST_F(SimplifyTest, KeepsValuesAndIsIdempotent) {
  RandomStream random(1, "simplify");
  for (int i = 0; i < 1'000; ++i) {
    RandomExpressions expressions(random, 3);
    const Expression e = expressions.Draw(5);
    const Expression simple = Simplify(e, 200);
    ASSERT_EQ(Simplify(simple, 200), simple) << Text(e) << "\n" << Text(simple);
    const std::vector<double> point = expressions.DrawPoint();
    const double value = Evaluate(e, std::span<const double>(point));
    if (std::isnan(value) || std::abs(value) > 1e6) continue;
    // Points near a pole of the expression lose digits. The interval shows how many they may lose.
    std::vector<Interval> box;
    for (const double x : point) box.push_back({x, x});
    const Interval range = Evaluate(simple, std::span<const Interval>(box));
    const double slack = 1e-7 * (1 + std::abs(value));
    EXPECT_LE(range.low - slack, value) << Text(e) << "\n" << Text(simple);
    EXPECT_GE(range.high + slack, value) << Text(e) << "\n" << Text(simple);
  }
}

TEST_F(SimplifyTest, LimitedExpansionIsIdempotent) {
  const Expression simple = Simplify(Read("(x + y + 1)*(x + z + 2)*(x + y + 1)*z"), 3);
  EXPECT_EQ(simple, Simplify(Read("z*(2 + z + x)*(1 + y + x)^2"), 3));
  EXPECT_EQ(Simplify(simple, 3), simple);
}

TEST_F(SimplifyTest, StaysInThePool) {
  EXPECT_EQ(Simplify(x_ - x_).pool(), &pool_);
  EXPECT_EQ(Simplify(Expression(2)), Expression(2));
}

}  // namespace
}  // namespace assay::algebra::simplify_test
