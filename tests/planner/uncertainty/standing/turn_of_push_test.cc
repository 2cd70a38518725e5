#include "planner/uncertainty/standing/turn_of_push.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "planner/domain/parts/part_model.h"
#include "tests/planner/uncertainty/part_on_table.h"

namespace assay::uncertainty::turn_of_push_test {
namespace {

using geometry::Vector2;

// Points of the block's base, which is a rectangle: uniform pressure on a grid, about its middle.
std::vector<Vector2> Pressure(const domain::PartModel& model) {
  Eigen::AlignedBox2d base;
  for (const Vector3& v : model.corners()) {
    if (std::abs(v.z()) < 1e-9) base.extend(Vector2(v.x(), v.y()));
  }
  constexpr int kPerSide = 40;
  std::vector<Vector2> points;
  for (int i = 0; i < kPerSide; ++i) {
    for (int j = 0; j < kPerSide; ++j) {
      const Vector2 share((i + 0.5) / kPerSide - 0.5, (j + 0.5) / kPerSide - 0.5);
      points.push_back(share.cwiseProduct(base.sizes()));
    }
  }
  return points;
}

// The turn for each metre of a push along y with the lever p along x: the part turns about the
// point on x, behind its middle, about which friction takes the least power (Mason 1986).
double TurnForEachMetre(const std::vector<Vector2>& pressure, double p) {
  double least = std::numeric_limits<double>::infinity();
  double turn = 0;
  for (double behind = 0; behind < 1; behind = behind * 1.02 + 1e-4) {
    double distance = 0;
    for (const Vector2& at : pressure) distance += (at - Vector2(-behind, 0)).norm();
    const double power = distance / (p + behind);
    if (power >= least) continue;
    least = power;
    turn = 1 / (p + behind);
  }
  return turn;
}

TEST(TurnOfPush, BoundsTheTurnOfLeastPowerUnderUniformPressure) {
  const domain::Problem problem = UprightBlock({});
  const UncertainWorld world(problem, Propagation::kSound);
  const domain::Part& block = problem.part(kBlock);
  const std::vector<Vector2> pressure = Pressure(*block.model);
  constexpr double kWay = 1e-3;
  const double bound = TurnOfPush(world, kBlock, block.X_WorldPart, kWay);
  double most = 0;
  for (const double p : {0.005, 0.01, 0.02, 0.03, 0.04, 0.06, 0.1}) {
    most = std::max(most, kWay * TurnForEachMetre(pressure, p));
  }
  EXPECT_GE(bound, most);
  EXPECT_LE(bound, 1.6 * most);
}

TEST(TurnOfPush, GrowsWithTheWayUpToHalfATurn) {
  const domain::Problem problem = UprightBlock({});
  const UncertainWorld world(problem, Propagation::kSound);
  const Pose& X_WorldPart = problem.part(kBlock).X_WorldPart;
  EXPECT_EQ(TurnOfPush(world, kBlock, X_WorldPart, 0), 0);
  EXPECT_NEAR(TurnOfPush(world, kBlock, X_WorldPart, 2e-3),
              2 * TurnOfPush(world, kBlock, X_WorldPart, 1e-3), 1e-12);
  EXPECT_EQ(TurnOfPush(world, kBlock, X_WorldPart, 10), std::numbers::pi);
}

// Returns the mean distance from `about` of three pressures whose mean is at `center`. Returns 0 if
// one of the pressures would pull.
double MeanDistanceOf(const std::array<Vector2, 3>& at, const Vector2& center,
                      const Vector2& about) {
  Eigen::Matrix3d balance;
  for (int i = 0; i < 3; ++i) balance.col(i) << at[static_cast<std::size_t>(i)], 1;
  if (std::abs(balance.determinant()) < 1e-9) return 0;
  const Vector3 shares = balance.inverse() * Vector3(center.x(), center.y(), 1);
  if (shares.minCoeff() < 0) return 0;
  double mean = 0;
  for (int i = 0; i < 3; ++i) mean += shares[i] * (at[static_cast<std::size_t>(i)] - about).norm();
  return mean;
}

// Whatever the pressure under the block is, its mean is below the centre of mass. Half of the
// samples press at corners.
TEST(RadiusAgainstTurn, BoundsTheMeanDistanceOfEveryPressure) {
  const domain::Problem problem = UprightBlock({});
  const UncertainWorld world(problem, Propagation::kSound);
  const domain::Part& block = problem.part(kBlock);
  const Vector2 center = (block.X_WorldPart * block.model->mass().center).head<2>();
  Eigen::AlignedBox2d base;
  for (const Vector3& v : block.model->corners()) {
    if (std::abs(v.z()) < 1e-9) base.extend(Vector2((block.X_WorldPart * v).head<2>()));
  }
  std::mt19937 random(27);
  std::uniform_real_distribution<double> share(0, 1);
  const auto sample = [&]() -> Vector2 {
    Vector2 at(share(random), share(random));
    if (share(random) < 0.5) at = at.array().round();
    return base.min() + at.cwiseProduct(base.sizes());
  };
  for (const Vector2& beside : {Vector2(0, 0), Vector2(0.02, 0), Vector2(-0.03, 0.05)}) {
    const Vector2 from = center + beside - Vector2(0, 0.01);
    const Vector2 to = center + beside + Vector2(0, 0.01);
    const Vector2 about(from.x(), std::clamp(center.y(), from.y(), to.y()));
    double most = 0;
    for (int i = 0; i < 20000; ++i) {
      most = std::max(most, MeanDistanceOf({sample(), sample(), sample()}, center, about));
    }
    const double bound = RadiusAgainstTurn(world, kBlock, block.X_WorldPart, {from, to});
    EXPECT_GE(bound, most - 1e-12);
    EXPECT_LE(bound, 1.001 * most) << "three corners were among the samples";
  }
}

}  // namespace
}  // namespace assay::uncertainty::turn_of_push_test
