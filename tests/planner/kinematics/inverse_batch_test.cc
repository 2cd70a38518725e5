#include "planner/kinematics/inverse_batch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "bench/workloads/reachable_poses.h"
#include "planner/base/random.h"
#include "planner/kinematics/arctangent.h"

namespace assay::kinematics::inverse_batch_test {
namespace {

constexpr double kPi = std::numbers::pi;

const Arm& Puma() {
  static const Arm arm =
      Arm::FromUrdf(std::string(ASSAY_SOURCE_DIR) + "/models/robots/puma762/puma762.urdf");
  return arm;
}

// Returns the difference of two angles without whole turns, radians.
double Apart(double a, double b) { return std::abs(std::remainder(a - b, 2 * kPi)); }

TEST(Arctangent, AgreesWithTheLibraryInAllDirectionsAndSizes) {
  RandomStream random(1, "arctangent");
  double worst = 0;
  for (int i = 0; i < 200'000; ++i) {
    const double angle = random.Uniform(-kPi, kPi);
    const double length = std::pow(10, random.Uniform(-12, 12));
    const double y = length * std::sin(angle);
    const double x = length * std::cos(angle);
    worst = std::max(worst, std::abs(Arctangent(y, x) - std::atan2(y, x)));
  }
  // The rounding of the library adds to the error.
  EXPECT_LE(worst, 5e-16 + std::numeric_limits<double>::epsilon());
}

TEST(Arctangent, KnowsTheAxesAndDiagonals) {
  for (int eighth = -3; eighth <= 4; ++eighth) {
    const double y = std::round(std::sin(eighth * kPi / 4));
    const double x = std::round(std::cos(eighth * kPi / 4));
    EXPECT_NEAR(Arctangent(y, x), eighth * kPi / 4, 5e-16) << eighth;
  }
}

TEST(InverseBatch, GivesTheSolutionsOfTheArmInItsOrder) {
  const std::vector<Pose> poses = workloads::RandomReachablePoses(Puma(), 8'000, 2);
  SolutionBatch found;
  int regular = 0;
  for (std::size_t first = 0; first < poses.size(); first += kBatch) {
    Inverse(*Puma().geometry(), Batch(std::span<const Pose, kBatch>(&poses[first], kBatch)), found);
    for (int pose = 0; pose < kBatch; ++pose) {
      if (!found.regular[static_cast<std::size_t>(pose)]) continue;
      ++regular;
      const InverseSolutions one = Puma().Inverse(poses[first + static_cast<std::size_t>(pose)]);
      ASSERT_EQ(one.size(), 8u);
      for (int k = 0; k < 8; ++k) {
        const std::size_t i = static_cast<std::size_t>(k);
        const JointVector q = found.Solution(k, pose);
        EXPECT_EQ(one[i].indicators, kBatchIndicators[i]);
        for (int joint = 0; joint < 6; ++joint) {
          EXPECT_LT(Apart(q[joint], one[i].q[joint]), 1e-9);
          EXPECT_LE(std::abs(q[joint]), kPi);
        }
      }
    }
  }
  EXPECT_GT(regular, 7'990);
}

// Returns whether the pose is regular. The batch holds the same pose eight times.
bool IsRegular(const Pose& X_BaseFlange) {
  std::array<Pose, kBatch> poses;
  poses.fill(X_BaseFlange);
  SolutionBatch found;
  Inverse(*Puma().geometry(), Batch(poses), found);
  EXPECT_THAT(found.regular, testing::Each(found.regular[0]));
  return found.regular[0];
}

TEST(InverseBatch, LeavesSingularAndUnreachablePosesToTheArm) {
  JointVector q;
  q << 0.3, -0.4, 0.5, 0.6, 0.7, 0.8;
  EXPECT_TRUE(IsRegular(Puma().Forward(q)));
  JointVector straight_wrist = q;
  straight_wrist[4] = 0;
  EXPECT_FALSE(IsRegular(Puma().Forward(straight_wrist)));
  JointVector stretched = q;
  stretched[2] = std::atan2(Puma().geometry()->d4, Puma().geometry()->a3);
  EXPECT_FALSE(IsRegular(Puma().Forward(stretched)));
  Pose far = Puma().Forward(q);
  far.translation() *= 10;
  EXPECT_FALSE(IsRegular(far));
  Pose by_the_waist = Puma().Forward(q);
  by_the_waist.translation() =
      Puma().geometry()->d6 * by_the_waist.linear().col(2) + geometry::Vector3(0.01, 0, 0.4);
  EXPECT_FALSE(IsRegular(by_the_waist));
}

}  // namespace
}  // namespace assay::kinematics::inverse_batch_test
