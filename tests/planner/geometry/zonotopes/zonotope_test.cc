#include "planner/geometry/zonotopes/zonotope.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/base/random.h"
#include "tests/planner/geometry/corners.h"

namespace assay::geometry::zonotope_test {
namespace {

constexpr double kRounding = 1e-12;

Eigen::MatrixXd RandomMatrix(int rows, int columns, RandomStream& random) {
  Eigen::MatrixXd m(rows, columns);
  for (double& entry : m.reshaped()) entry = random.Uniform(-1, 1);
  return m;
}

Eigen::VectorXd RandomVector(int size, RandomStream& random) {
  return RandomMatrix(size, 1, random);
}

Zonotope RandomZonotope(int dimension, int generators, RandomStream& random) {
  return {RandomVector(dimension, random), RandomMatrix(dimension, generators, random)};
}

TEST(Zonotope, BoxHasTheBoxesCornersAndNoGeneratorWhereItIsFlat) {
  const Zonotope box = Zonotope::Box(Eigen::Vector3d(-1, 2, 0), Eigen::Vector3d(3, 2, 0.5));
  EXPECT_EQ(box.generators.cols(), 2);
  EXPECT_EQ(box.Farthest(Eigen::Vector3d(1, 1, -1)), Eigen::Vector3d(3, 2, 0));
  EXPECT_EQ(box.Farthest(Eigen::Vector3d(-1, 1, 1)), Eigen::Vector3d(-1, 2, 0.5));
  EXPECT_DOUBLE_EQ(box.Support(Eigen::Vector3d(2, 1, -4)), 8);
}

TEST(Zonotope, SupportIsTheGreatestOverTheCorners) {
  RandomStream random(7, "support");
  for (int trial = 0; trial < 200; ++trial) {
    const Zonotope z = RandomZonotope(4, 6, random);
    const Eigen::VectorXd a = RandomVector(4, random);
    double greatest = a.dot(z.center);
    for (const Eigen::VectorXd& corner : Corners(z)) greatest = std::max(greatest, a.dot(corner));
    EXPECT_NEAR(z.Support(a), greatest, kRounding);
    EXPECT_NEAR(a.dot(z.Farthest(a)), greatest, kRounding);
  }
}

TEST(Zonotope, SupportIsPositivelyHomogeneousAndSubadditive) {
  RandomStream random(7, "laws");
  for (int trial = 0; trial < 200; ++trial) {
    const Zonotope z = RandomZonotope(6, 8, random);
    const Eigen::VectorXd a = RandomVector(6, random);
    const Eigen::VectorXd b = RandomVector(6, random);
    EXPECT_NEAR(z.Support(3 * a), 3 * z.Support(a), kRounding);
    EXPECT_LE(z.Support(a + b), z.Support(a) + z.Support(b) + kRounding);
    EXPECT_GE(z.Support(a) + z.Support(-a), 0);
  }
}

}  // namespace
}  // namespace assay::geometry::zonotope_test
