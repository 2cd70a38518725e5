#include "planner/algebra/bounding_methods/quadratic_bound.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/base/random.h"

namespace assay::algebra::quadratic_bound_test {
namespace {

numeric::SymmetricMatrix Matrix(const std::vector<std::vector<double>>& lower) {
  numeric::SymmetricMatrix matrix;
  matrix.Reset(static_cast<int>(lower.size()));
  for (std::size_t i = 0; i < lower.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      matrix(static_cast<int>(i), static_cast<int>(j)) = lower[i][j];
    }
  }
  return matrix;
}

double Quadratic(const numeric::SymmetricMatrix& m, const std::vector<double>& x) {
  double sum = 0;
  for (int i = 0; i < m.size(); ++i) {
    for (int j = 0; j < m.size(); ++j) {
      sum += x[i] * x[j] * m(std::max(i, j), std::min(i, j));
    }
  }
  return sum;
}

TEST(PositiveDefinite, FactorsAndSolves) {
  numeric::SymmetricMatrix m = Matrix({{4}, {2, 3}});
  ASSERT_TRUE(FactorPositiveDefinite(m));
  std::vector<double> b = {2, 5};
  SolveFactored(m, b);
  EXPECT_NEAR(b[0], -0.5, 1e-15);
  EXPECT_NEAR(b[1], 2, 1e-15);
}

TEST(PositiveDefinite, RefusesWhatIsNot) {
  numeric::SymmetricMatrix m = Matrix({{1}, {2, 1}});
  EXPECT_FALSE(FactorPositiveDefinite(m));
}

TEST(PositiveDefinite, DeviationsCount) {
  const numeric::SymmetricMatrix centre = Matrix({{1}, {0.5, 1}});
  EXPECT_TRUE(IsSurelyPositiveDefinite(centre, Matrix({{0.1}, {0.1, 0.1}})));
  // The matrix [[0.8, 0.8], [0.8, 0.8]] is within these deviations.
  EXPECT_FALSE(IsSurelyPositiveDefinite(centre, Matrix({{0.2}, {0.3, 0.2}})));
}

// The bound is compared with random points and with random curvatures that are less than the given
// one.
TEST(QuadraticBound, NoPointIsHigher) {
  RandomStream random(1, "quadratic");
  int concave = 0;
  for (int i = 0; i < 500; ++i) {
    const int n = 1 + random.Index(4);
    numeric::SymmetricMatrix curvature;
    curvature.Reset(n);
    std::vector<double> widths, slopes;
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k <= j; ++k) curvature(j, k) = random.Uniform(-1, 1) - (j == k ? 2 : 0);
      widths.push_back(random.Uniform(0, 2));
      slopes.push_back(random.Uniform(-1, 1));
    }
    QuadraticBound bound;
    bound.SetCurvature(curvature, 1e-12, widths);
    const double most = bound.Most(slopes);
    concave += bound.IsConcave() ? 1 : 0;
    for (int sample = 0; sample < 50; ++sample) {
      std::vector<double> d, direction;
      double value = 0, along = 0;
      for (int j = 0; j < n; ++j) {
        d.push_back(random.Uniform(-0.5, 0.5) * widths[j]);
        direction.push_back(random.Uniform(-1, 1));
        value += slopes[j] * d[j];
        along += direction[j] * d[j];
      }
      // The curvature is reduced by direction direction^T.
      value += (Quadratic(curvature, d) - (sample % 2) * along * along) / 2;
      EXPECT_GE(most, value);
      EXPECT_TRUE(!bound.IsConcave() || Quadratic(curvature, direction) <= 0);
    }
  }
  EXPECT_GT(concave, 100);
  EXPECT_LT(concave, 500);
}

TEST(QuadraticBound, IsTightWhereTheSummitIsInside) {
  QuadraticBound bound;
  bound.SetCurvature(Matrix({{-2}, {-1, -2}}), 0, std::vector<double>{2, 2});
  ASSERT_TRUE(bound.IsConcave());
  // The greatest value is s . d / 2 at d = -C^-1 s = (1/3, 1/3).
  EXPECT_NEAR(bound.Most(std::vector<double>{1, 1}), 1.0 / 3, 0.02);
}

}  // namespace
}  // namespace assay::algebra::quadratic_bound_test
