#include "planner/numeric/nonnegative_least_squares.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>
#include <vector>

#include "planner/base/random.h"

namespace assay::numeric::nonnegative_least_squares_test {
namespace {

// Returns the least residual over all sets of columns that may be positive.
double LeastResidual(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  double least = b.norm();
  for (int set = 1; set < (1 << a.cols()); ++set) {
    std::vector<int> columns;
    for (int i = 0; i < a.cols(); ++i) {
      if ((set >> i & 1) != 0) columns.push_back(i);
    }
    const Eigen::MatrixXd some = a(Eigen::all, columns);
    const Eigen::VectorXd x = some.completeOrthogonalDecomposition().solve(b);
    if (x.minCoeff() >= 0) least = std::min(least, (some * x - b).norm());
  }
  return least;
}

TEST(NonnegativeLeastSquares, IsTheBestOfAllSetsOfColumns) {
  RandomStream random(1, "nnls");
  for (int round = 0; round < 2000; ++round) {
    const int rows = 1 + random.Index(7);
    const int columns = 1 + random.Index(7);
    Eigen::MatrixXd a(rows, columns);
    Eigen::VectorXd b(rows);
    for (double& value : a.reshaped()) value = random.Uniform(-1, 1);
    for (double& value : b) value = random.Uniform(-1, 1);
    // Dependent columns have no unique combination.
    if (columns > 2 && round % 3 == 0) a.col(1) = a.col(0) + 0.5 * a.col(2);
    if (columns > 1 && round % 5 == 0) a.col(1) = 2 * a.col(0);
    const Eigen::VectorXd x = NonnegativeLeastSquares(a, b);
    ASSERT_EQ(x.size(), columns);
    EXPECT_GE(x.minCoeff(), 0);
    EXPECT_NEAR((a * x - b).norm(), LeastResidual(a, b), 1e-9) << "round " << round;
  }
}

TEST(NonnegativeLeastSquares, OfNothing) {
  EXPECT_EQ(NonnegativeLeastSquares(Eigen::MatrixXd(3, 0), Eigen::Vector3d::UnitX()).size(), 0);
  EXPECT_EQ(
      NonnegativeLeastSquares(Eigen::MatrixXd::Identity(3, 3), Eigen::Vector3d::Zero()).norm(), 0);
}

}  // namespace
}  // namespace assay::numeric::nonnegative_least_squares_test
