#include "planner/algebra/multiaffine/multiaffine_form.h"
#include "planner/algebra/normal_forms/normalization.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/workloads/transform_chains.h"
#include "planner/algebra/multiaffine/multiaffine_derivatives.h"
#include "planner/algebra/multiaffine/multiaffine_point.h"
#include "tests/oracle/random_expression.h"

namespace assay::algebra::multiaffine_form_test {
namespace {

std::optional<MultiaffineForm> FormOf(const Expression& e) {
  return MultiaffineFormOf(NormalFormOf(e));
}

class MultiaffineFormTest : public testing::Test {
 protected:
  ExpressionPool pool_;
  Expression x_ = pool_.Declare("x", {-1, 2});
  Expression y_ = pool_.Declare("y", {-3, 1});
  Expression t_ = pool_.Declare("t", {-1, 1});
};

TEST_F(MultiaffineFormTest, KnowsItsKind) {
  EXPECT_TRUE(FormOf(x_ + 2 * y_));
  EXPECT_TRUE(FormOf(x_ * y_ * Cos(t_) - Sin(t_)));
  EXPECT_TRUE(FormOf(Power(Sin(t_), 2) + Power(Cos(t_), 2) + x_));  // it equals 1 + x
  EXPECT_FALSE(FormOf(x_ * x_ + y_));
  EXPECT_FALSE(FormOf(Sin(t_) * Cos(t_)));
  EXPECT_FALSE(FormOf(t_ + Sin(t_)));
  EXPECT_FALSE(FormOf(Sin(2 * t_)));
  EXPECT_FALSE(FormOf(Abs(x_)));
  EXPECT_FALSE(FormOf(1 / x_));
  EXPECT_FALSE(FormOf(pool_.Constant(3)));
}

TEST_F(MultiaffineFormTest, AnglesComeFirst) {
  const auto form = FormOf(x_ + x_ * y_ + y_ + x_ * Cos(t_));
  ASSERT_TRUE(form);
  ASSERT_EQ(form->angle_count, 1);
  EXPECT_EQ(form->variables[0].id, t_.variable());
  EXPECT_EQ(form->variables[1].id, x_.variable());  // it occurs in three terms
  EXPECT_EQ(form->variables[2].id, y_.variable());
}

// The values are compared with outward-rounded interval arithmetic. Both intervals contain the true
// value.
TEST(MultiaffineForm, ErrorsOfValuesAreBounded) {
  RandomStream random(1, "errors");
  for (int i = 0; i < 60; ++i) {
    ExpressionPool pool;
    const Expression e =
        i % 2 == 0 ? workloads::PlanarChain(2 + i % 4, workloads::kWideErrors, random, pool)
                   : workloads::CancellingChain(1 + i % 2, workloads::kWideErrors, random, pool);
    const auto form = FormOf(e);
    ASSERT_TRUE(form);
    std::vector<double> place;
    for (int v = 0; v < pool.variable_count(); ++v) place.push_back(random.Uniform(-0.5, 0.5));
    MultiaffinePoint point(*form), magnitudes(*form);
    for (std::size_t v = 0; v < form->variables.size(); ++v) {
      const double x = place[form->variables[v].id.index()];
      point.Set(static_cast<int>(v), x);
      if (!form->variables[v].is_angle) magnitudes.Set(static_cast<int>(v), std::abs(x));
    }
    const double value = point.derivatives().Value(form->nested);
    const double error = magnitudes.derivatives().Value(form->point_error);
    const Interval truth = oracle::ValueAt(e, place);
    EXPECT_LE(value - error, truth.high);
    EXPECT_GE(value + error, truth.low);
    EXPECT_GT(error, 0);
    EXPECT_LE(error, 1e-10);
    EXPECT_LE(error, magnitudes.derivatives().Value(form->error));
  }
}

// The oracle computes derivatives by differences of values.
TEST(MultiaffineForm, DerivativesByVariables) {
  constexpr double kStep = 1e-4;
  RandomStream random(2, "derivatives");
  ExpressionPool pool;
  const auto form = FormOf(workloads::SpatialChain(3, workloads::kWideErrors, random, pool));
  ASSERT_TRUE(form);
  std::vector<double> place;
  MultiaffinePoint point(*form);
  const auto value_with = [&](int variable, double step) {
    point.Set(variable, place[variable] + step);
    const double value = point.derivatives().Value(form->nested);
    point.Set(variable, place[variable]);
    return value;
  };
  const auto slope_at = [&](int variable) {
    point.derivatives().Value(form->nested);
    point.derivatives().Differentiate(form->nested);
    return point.derivatives().Slope(variable);
  };
  for (std::size_t v = 0; v < form->variables.size(); ++v) {
    place.push_back(random.Uniform(-0.5, 0.5));
    point.Set(static_cast<int>(v), place.back());
  }
  for (int v = 0; v < static_cast<int>(place.size()); ++v) {
    const double difference = (value_with(v, kStep) - value_with(v, -kStep)) / (2 * kStep);
    EXPECT_NEAR(slope_at(v), difference, 1e-6);
    if (v >= form->angle_count) continue;
    const double second =
        (value_with(v, kStep) - 2 * value_with(v, 0) + value_with(v, -kStep)) / (kStep * kStep);
    slope_at(v);
    EXPECT_NEAR(point.derivatives().Curvature(v), second, 1e-5);
    point.Set(v, place[v] + kStep);
    const double after = slope_at(0);
    point.Set(v, place[v] - kStep);
    const double mixed = (after - slope_at(0)) / (2 * kStep);
    point.Set(v, place[v]);
    slope_at(v);
    if (v == 0) continue;
    point.derivatives().DifferentiateSlopes(form->nested, v);
    EXPECT_NEAR(point.derivatives().MixedCurvature(0), mixed, 1e-6);
  }
}

}  // namespace
}  // namespace assay::algebra::multiaffine_form_test
