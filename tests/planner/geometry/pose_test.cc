#include "planner/geometry/pose.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/oracle/random_pose.h"

namespace assay::geometry::pose_test {
namespace {

using oracle::RandomPose;
using oracle::RandomRotation;

constexpr double kPi = std::numbers::pi;
constexpr std::uint64_t kSeed = 11;

TEST(PoseTest, TranslationsAndRotationsActAsTheirNamesSay) {
  EXPECT_TRUE((Translation(1, 2, 3) * Vector3(4, 5, 6)).isApprox(Vector3(5, 7, 9)));
  EXPECT_TRUE(Translation(Vector3(1, 2, 3)).isApprox(Translation(1, 2, 3)));
  EXPECT_TRUE((RotationX(kPi / 2) * Vector3::UnitY()).isApprox(Vector3::UnitZ()));
  EXPECT_TRUE((RotationY(kPi / 2) * Vector3::UnitZ()).isApprox(Vector3::UnitX()));
  EXPECT_TRUE((RotationZ(kPi / 2) * Vector3::UnitX()).isApprox(Vector3::UnitY()));
}

TEST(PoseTest, RotationsAboutOneAxisAdd) {
  for (const auto rotation : {RotationX, RotationY, RotationZ}) {
    EXPECT_TRUE((rotation(0.3) * rotation(1.1)).isApprox(rotation(1.4)));
    EXPECT_TRUE((rotation(0.3) * rotation(-0.3)).isApprox(Pose::Identity()));
  }
}

TEST(PoseTest, ColumnsAreTheAxesMadeOrthonormal) {
  RandomStream random(kSeed, "columns");
  for (int i = 0; i < 1000; ++i) {
    const Pose X = RandomPose(random, 2);
    Matrix3 rough = X.linear();
    for (double& entry : rough.reshaped()) entry += random.Uniform(-1e-7, 1e-7);
    const Pose made = PoseFromColumns(rough.col(0), rough.col(1), rough.col(2), X.translation());
    EXPECT_LT((made.linear() - X.linear()).norm(), 1e-6);
    EXPECT_LT((made.linear().transpose() * made.linear() - Matrix3::Identity()).norm(), 1e-14);
    EXPECT_EQ(made.translation(), X.translation());
  }
}

TEST(PoseDeathTest, ColumnsThatAreNoRotationStopTheProgram) {
  const Vector3 x = Vector3::UnitX(), y = Vector3::UnitY(), z = Vector3::UnitZ();
  EXPECT_DEATH(PoseFromColumns(x, y, -z, Vector3::Zero()), "");
  EXPECT_DEATH(PoseFromColumns(x, x, z, Vector3::Zero()), "");
  EXPECT_DEATH(PoseFromColumns(2 * x, y, z, Vector3::Zero()), "");
}

TEST(PoseTest, AngleBetweenIsAMetricOnRotations) {
  RandomStream random(kSeed, "angle");
  for (int i = 0; i < 1000; ++i) {
    const Matrix3 A = RandomRotation(random), B = RandomRotation(random),
                  C = RandomRotation(random);
    const double ab = AngleBetween(A, B);
    EXPECT_GE(ab, 0);
    EXPECT_LE(ab, kPi + 1e-12);
    EXPECT_NEAR(ab, AngleBetween(B, A), 1e-9);
    EXPECT_NEAR(ab, AngleBetween(C * A, C * B), 1e-7);
    EXPECT_LE(ab, AngleBetween(A, C) + AngleBetween(C, B) + 1e-9);
  }
  EXPECT_NEAR(AngleBetween(RotationX(0.2).linear(), RotationX(-1.1).linear()), 1.3, 1e-12);
  EXPECT_NEAR(AngleBetween(RotationZ(-2).linear(), RotationZ(2).linear()), 2 * kPi - 4, 1e-12);
}

}  // namespace
}  // namespace assay::geometry::pose_test
