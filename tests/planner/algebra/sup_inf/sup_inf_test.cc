#include "planner/algebra/sup_inf/sup_inf.h"
#include "planner/algebra/expression/evaluation.h"
#include "planner/algebra/expression/nodes.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/base/random.h"
#include "planner/numeric/interval_arithmetic.h"
#include "tests/planner/algebra/random_linear_programs.h"

namespace assay::algebra::sup_inf_test {
namespace {

// The variables x, y, z and the constraints between them.
class SupInf : public testing::Test {
 protected:
  Expression Declare(const std::string& name, const Interval& bounds = kWholeLine) {
    const Expression variable = pool.Declare(name, bounds);
    constraints.box.push_back(bounds);
    return variable;
  }
  void Post(const Expression& lesser, const Expression& greater) {
    constraints.inequalities.push_back({.lesser = lesser, .greater = greater});
  }
  Expression SupOf(const Expression& j, const std::set<VariableId>& keep = {}) const {
    return Sup(j, keep, constraints);
  }
  Expression InfOf(const Expression& j, const std::set<VariableId>& keep = {}) const {
    return Inf(j, keep, constraints);
  }

  ExpressionPool pool;
  ConstraintSet constraints;
};

TEST_F(SupInf, BoundsByOtherVariables) {
  const Expression x = Declare("x"), y = Declare("y");
  Post(x, y + 1);
  Post(x, 5 - y);
  EXPECT_EQ(SupOf(x), Expression(3));
  EXPECT_EQ(SupOf(y), Expression(kInfinity));
  EXPECT_EQ(InfOf(x), Expression(-kInfinity));
}

TEST_F(SupInf, KeepsVariables) {
  const Expression x = Declare("x"), y = Declare("y");
  Post(x, y);
  Post(y, 3);
  EXPECT_EQ(SupOf(x), Expression(3));
  EXPECT_EQ(SupOf(x, {y.variable()}), y);
  EXPECT_EQ(InfOf(y, {x.variable()}), x);
  EXPECT_EQ(SupOf(y, {y.variable()}), y);
}

TEST_F(SupInf, KeepsTheLeastOfSeveralBounds) {
  const Expression x = Declare("x", {0, 5}), y = Declare("y"), z = Declare("z");
  Post(x, y);
  Post(2 * x, z + 1);
  EXPECT_EQ(Evaluate(SupOf(x, {y.variable(), z.variable()}), std::vector{0., 2., 9.}), 2);
  EXPECT_EQ(Evaluate(SupOf(x, {y.variable(), z.variable()}), std::vector{0., 9., 2.}), 1.5);
  EXPECT_EQ(Evaluate(SupOf(x, {y.variable(), z.variable()}), std::vector{0., 9., 99.}), 5);
  EXPECT_EQ(SupOf(x), Expression(5));
}

TEST_F(SupInf, NumbersAndEmptyConstraints) {
  const Expression x = Declare("x", {-1, 2});
  EXPECT_EQ(SupOf(7), Expression(7));
  EXPECT_EQ(SupOf(3 - 2 * x), Expression(5));
  EXPECT_EQ(InfOf(3 - 2 * x), Expression(-1));
  EXPECT_EQ(SupOf(x / 4), Expression(0.5));
}

// An expression counts as linear if its normal form is linear.
TEST_F(SupInf, LinearUpToNormalForm) {
  const Expression x = Declare("x"), y = Declare("y");
  Post(x * (y + 1) - y * x, y + 1);
  Post((x + y) * 3, 15);
  EXPECT_EQ(SupOf((x + 1) * (x - 1) - x * x + x), Expression(2));
  EXPECT_EQ(SupOf(x), Expression(3));
  EXPECT_EQ(TightenedBox(constraints)[0], (Interval{-kInfinity, 3}));
}

// Numbers that are no doubles give valid bounds, too.
TEST_F(SupInf, SymbolicNumbersStayBounds) {
  const Expression x = Declare("x", {-2, 2}), y = Declare("y", {-2, 2});
  Post(3 * x, y + 1);
  Post(0.1 * x, 0.7 * y + 0.9);
  const Expression sup = SupOf(x, {y.variable()});
  EXPECT_THAT(VariablesOf(sup), testing::ElementsAre(y.variable()));
  for (const double at : {-1.5, -1.0, 0.3, 1.0, 2.0}) {
    const std::vector<Interval> box = {{0, 0}, {at, at}};
    const double bound = Evaluate(sup, box).high;
    const double greatest = Evaluate(SupOf(x + 0 * y), std::vector<Interval>{{}, {}}).high;
    EXPECT_GE(bound, (at + 1) / 3 < 9 + 7 * at ? (at + 1) / 3 : 9 + 7 * at);
    EXPECT_LE(bound, greatest + 1e-15);
  }
}

TEST_F(SupInf, ProductsOfKnownSignKeepVariables) {
  const Expression x = Declare("x", {1, 3}), up = Declare("up", {0, 2});
  const Expression down = Declare("down", {-2, 0}), any = Declare("any", {-1, 2});
  EXPECT_EQ(SupOf(x * up, {up.variable()}), 3 * up);
  EXPECT_EQ(InfOf(x * up, {up.variable()}), up);
  EXPECT_EQ(SupOf(x * down, {down.variable()}), down);
  EXPECT_EQ(InfOf(x * down, {down.variable()}), 3 * down);
  const Expression of_square = SupOf(Power(x, 2) * up + 1, {up.variable()});
  EXPECT_NEAR(Evaluate(of_square, std::vector{0., 1.5, 0., 0.}), 9 * 1.5 + 1, 1e-14);
  // The sign of the factor is unknown, so that the bound is a number.
  EXPECT_NEAR(SupOf(x * any, {any.variable()}).constant(), 6, 1e-14);
}

TEST_F(SupInf, ProductsTakeSymbolicBoundsOfFactors) {
  const Expression x = Declare("x", {1, 9}), y = Declare("y", {0, 2}), z = Declare("z", {2, 4});
  Post(x, z);
  const Expression sup = SupOf(x * y, {y.variable(), z.variable()});
  EXPECT_EQ(Evaluate(sup, std::vector{0., 1.5, 3.}), 4.5);
  EXPECT_NEAR(SupOf(x * y).constant(), 8, 1e-14);
}

TEST_F(SupInf, OperandsOfMinAndMax) {
  const Expression x = Declare("x", {-1, 2}), y = Declare("y", {0, 5});
  Post(x + y, 4);
  EXPECT_EQ(SupOf(Min(x, y)), Expression(2));
  EXPECT_EQ(InfOf(Max(x, y)), Expression(0));
  EXPECT_EQ(SupOf(Max(x, y - 1)), Expression(4));
  EXPECT_EQ(SupOf(Max(x, y), {y.variable()}), Max(SupOf(x, {y.variable()}), y));
  // The bound follows from min(x, y) <= (x + y) / 2.
  EXPECT_EQ(SupOf(Min(3 * x, y)), Expression(3));
}

// A product that occurs in a constraint and in the bounded expression is treated as one unknown.
TEST_F(SupInf, NonLinearConstraintsBoundTheirTerms) {
  const Expression x = Declare("x", {0, 2}), t = Declare("t", {-1, 1});
  Post(x + Cos(t), 1.5);
  EXPECT_EQ(SupOf(2 * x + 2 * Cos(t)), Expression(3));
  EXPECT_EQ(TightenedBox(constraints)[0], (Interval{0, 2}));
  Post(Power(x, 2) * t, 0.5);
  EXPECT_EQ(SupOf(Power(x, 2) * t), Expression(0.5));
}

TEST_F(SupInf, WhatNothingBoundsIsInfinite) {
  const Expression x = Declare("x", {-1, 2}), free = Declare("free");
  EXPECT_EQ(SupOf(1 / x), Expression(kInfinity));
  EXPECT_EQ(InfOf(1 / x), Expression(-kInfinity));
  EXPECT_EQ(SupOf(free * x), Expression(kInfinity));
  EXPECT_EQ(InfOf(free * free), Expression(0));
  EXPECT_EQ(SupOf(Sin(free)), Expression(1));
  EXPECT_EQ(SupOf(x + free, {x.variable()}), Expression(kInfinity));
  EXPECT_EQ(InfOf(x + free, {x.variable()}), Expression(-kInfinity));
}

TEST_F(SupInf, TightenedBoxHasExactEnds) {
  const Expression x = Declare("x", {-9, 9}), y = Declare("y", {0, kInfinity}), z = Declare("z");
  Post(x, y + 1);
  Post(x, 5 - y);
  Post(2, x);
  Post(Power(z, 2), 4);
  EXPECT_THAT(TightenedBox(constraints),
              testing::ElementsAre(Interval{2, 3}, Interval{1, 3}, kWholeLine));
}

TEST_F(SupInf, ContradictionsLeaveABoxOfIntervals) {
  const Expression x = Declare("x", {0, 1}), y = Declare("y", {0, 1});
  Post(x + 2, y);
  for (const Interval& interval : TightenedBox(constraints)) {
    EXPECT_LE(interval.low, interval.high);
  }
  SupOf(x * y);
  SupOf(x * y, {y.variable()});
}

TEST_F(SupInf, SharedSubexpressionsAreReadOnce) {
  Expression e = Declare("x", {0, 1}) + Declare("y", {0, 1});
  for (int i = 0; i < 60; ++i) e = 0.25 * e + e / 4 + Cos(e) * 0;
  EXPECT_EQ(SupOf(e), Expression(std::ldexp(2, -60)));
}

// ---- Linear systems against GLPK ---------------------------------------------------------------

Expression SumOf(const std::vector<double>& coefficients, ExpressionPool& pool) {
  Expression sum = 0;
  for (std::size_t v = 0; v < coefficients.size(); ++v) {
    sum = sum + coefficients[v] * pool.Variable(VariableId(v));
  }
  return sum;
}

struct System {
  explicit System(const oracle::LinearProgram& program) {
    for (std::size_t v = 0; v < program.box.size(); ++v) {
      pool.Declare(fmt::format("v{}", v), program.box[v]);
    }
    constraints = DeclaredBox(pool);
    for (const oracle::LinearProgram::Row& row : program.rows) {
      constraints.inequalities.push_back({SumOf(row.coefficients, pool), row.upper});
    }
    objective = SumOf(program.objective, pool);
  }
  System(const System&) = delete;

  ExpressionPool pool;
  ConstraintSet constraints;
  Expression objective;
};

TEST(SupInfAgainstGlpk, LinearSystemsExactly) {
  RandomStream random(2026, "sup-inf");
  for (int count = 0; count < 1500;) {
    const int variables = 2 + random.Index(4);
    oracle::LinearProgram program = RandomLinearProgram(random, variables, variables + 1);
    const oracle::Maximum greatest = oracle::Maximize(program);
    if (greatest.kind == oracle::Maximum::Kind::kContradiction) continue;
    System system(program);
    for (double& coefficient : program.objective) coefficient = -coefficient;
    const oracle::Maximum least = oracle::Maximize(program);
    const bool bounded_above = greatest.kind == oracle::Maximum::Kind::kFinite;
    const bool bounded_below = least.kind == oracle::Maximum::Kind::kFinite;
    ASSERT_EQ(Sup(system.objective, {}, system.constraints).constant(),
              bounded_above ? oracle::RoundedUp(greatest.value) : kInfinity);
    ASSERT_EQ(Inf(system.objective, {}, system.constraints).constant(),
              bounded_below ? -oracle::RoundedUp(least.value) : -kInfinity);
    ++count;
  }
}

// ---- Laws on random non-linear expressions ------------------------------------------------------

// Random expressions with every operation, over boxes that contain the origin.
class RandomProblem {
 public:
  explicit RandomProblem(RandomStream& random) : random_(random) {
    for (const char* name : {"x", "y", "z"}) {
      pool.Declare(name, {-random.Uniform(0, 2), random.Uniform(0, 2)});
    }
    constraints = DeclaredBox(pool);
    for (int i = 0; i < 3; ++i) {
      constraints.inequalities.push_back({Make(2) - Evaluate(Make(1), kOrigin), Make(1) + 1});
      Inequality& inequality = constraints.inequalities.back();
      // The constraint is shifted so that the origin satisfies it.
      const double slack =
          Evaluate(inequality.greater, kOrigin) - Evaluate(inequality.lesser, kOrigin);
      if (!(slack >= 0)) inequality.greater = inequality.greater - slack + 0.5;
    }
  }

  Expression Make(int depth) {
    const auto deeper = [&] { return Make(depth - 1); };
    if (depth == 0) {
      return random_.Index(4) == 0 ? Expression(random_.Index(9) * 0.25 - 1)
                                   : pool.Variable(VariableId(random_.Index(3)));
    }
    switch (random_.Index(12)) {
      case 0:
        return Sin(deeper());
      case 1:
        return Cos(deeper());
      case 2:
        return Abs(deeper());
      case 3:
        return Min(deeper(), deeper());
      case 4:
        return Max(deeper(), deeper());
      case 5:
        return Power(deeper(), 2 + random_.Index(2));
      case 6:
        return deeper() / (Power(deeper(), 2) + 1);
      case 7:
        return Sqrt(Abs(deeper()));
      case 8:
      case 9:
        return deeper() * deeper();
      default:
        return deeper() - deeper();
    }
  }

  std::vector<double> Point() {
    std::vector<double> point;
    for (const auto& [low, high] : constraints.box) point.push_back(random_.Uniform(low, high));
    return point;
  }

  bool IsFeasible(const std::vector<double>& point) const {
    return std::ranges::all_of(constraints.inequalities, [&](const Inequality& inequality) {
      return Evaluate(inequality.lesser, point) <= Evaluate(inequality.greater, point);
    });
  }

  inline static const std::vector<double> kOrigin = {0, 0, 0};
  ExpressionPool pool;
  ConstraintSet constraints;

 private:
  RandomStream& random_;
};

// The tolerance for values that are computed in doubles.
double Slack(double value) { return 1e-9 * (1 + std::abs(value)); }

TEST(SupInfLaws, FeasiblePointsAreNeverOutside) {
  RandomStream random(2026, "laws");
  int points = 0;
  for (int i = 0; i < 300; ++i) {
    RandomProblem problem(random);
    const Expression j = problem.Make(3);
    const VariableId kept(random.Index(3));
    const Expression sup = Sup(j, {}, problem.constraints), inf = Inf(j, {}, problem.constraints);
    const Expression sup_kept = Sup(j, {kept}, problem.constraints);
    const Expression inf_kept = Inf(j, {kept}, problem.constraints);
    const std::vector<Interval> box = TightenedBox(problem.constraints);
    for (int sample = 0; sample < 40; ++sample) {
      const std::vector<double> point = sample == 0 ? RandomProblem::kOrigin : problem.Point();
      if (!problem.IsFeasible(point)) continue;
      ++points;
      const double value = Evaluate(j, point);
      ASSERT_LE(value, sup.constant() + Slack(value)) << i;
      ASSERT_GE(value, inf.constant() - Slack(value)) << i;
      ASSERT_LE(value, Evaluate(sup_kept, point) + Slack(value)) << i;
      ASSERT_GE(value, Evaluate(inf_kept, point) - Slack(value)) << i;
      for (std::size_t v = 0; v < box.size(); ++v) {
        ASSERT_TRUE(box[v].low <= point[v] + 1e-9 && point[v] <= box[v].high + 1e-9) << i;
      }
    }
    for (const VariableId v : VariablesOf(sup_kept)) ASSERT_EQ(v, kept);
  }
  EXPECT_GT(points, 2000);
}

// The law holds up to the rounding of nonlinear terms.
TEST(SupInfLaws, InfIsTheMirrorOfSup) {
  RandomStream random(2026, "mirror");
  for (int i = 0; i < 200; ++i) {
    RandomProblem problem(random);
    const Expression j = problem.Make(3);
    const double inf = Inf(j, {}, problem.constraints).constant();
    ASSERT_NEAR(inf, -Sup(-j, {}, problem.constraints).constant(), 1e-12 * (1 + std::abs(inf)));
  }
}

TEST(SupInfLaws, NeverWorseThanIntervalArithmetic) {
  RandomStream random(2026, "intervals");
  for (int i = 0; i < 200; ++i) {
    RandomProblem problem(random);
    const Expression j = problem.Make(3);
    const Interval range = Evaluate(j, std::span<const Interval>(problem.constraints.box));
    ASSERT_LE(Sup(j, {}, problem.constraints).constant(), range.high);
    ASSERT_GE(Inf(j, {}, problem.constraints).constant(), range.low);
  }
}

// More constraints never loosen the bound of a linear expression.
TEST(SupInfLaws, ConstraintsTighten) {
  RandomStream random(2026, "monotone");
  for (int i = 0; i < 300; ++i) {
    const oracle::LinearProgram program = RandomLinearProgram(random, 3, 5);
    if (oracle::Maximize(program).kind == oracle::Maximum::Kind::kContradiction) continue;
    System system(program);
    ConstraintSet fewer = system.constraints;
    fewer.inequalities.pop_back();
    ASSERT_LE(Sup(system.objective, {}, system.constraints).constant(),
              Sup(system.objective, {}, fewer).constant());
  }
}

}  // namespace
}  // namespace assay::algebra::sup_inf_test
