#include "planner/domain/grasps/hand_clearance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "planner/geometry/box.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/separation.h"
#include "tests/oracle/random_pose.h"
#include "tests/planner/domain/parts.h"

namespace assay::domain::hand_clearance_test {
namespace {

using geometry::Box;

constexpr std::uint64_t kSeed = 21;
constexpr double kAllowance = 1e-4;

// Returns the deepest overlap of the boxes of gripper and part, metres, with the tool at
// X_PartTool. If negative, its magnitude is at most the least distance.
double DeepestOverlap(const PartModel& part, const std::vector<Box>& gripper,
                      const Pose& X_PartTool) {
  double deepest = -1e9;
  for (const Box& box : gripper) {
    for (const geometry::ConvexHull& other : part.pieces()) {
      deepest =
          std::max(deepest, -geometry::Separation(HullOf(box.Transformed(X_PartTool)), other));
    }
  }
  return deepest;
}

// Returns the deepest overlap at steps along the whole way in with the gripper open, and at its end
// with the gripper closed.
double DeepestOnTheWay(const PartModel& part, double width, const Pose& X_PartTool, double length) {
  const kinematics::Gripper& gripper = ParallelJaw();
  std::vector<Box> opened = gripper.FingerBoxes(gripper.max_opening());
  opened.insert(opened.end(), gripper.HandBoxes().begin(), gripper.HandBoxes().end());
  constexpr int kSteps = 50;
  double deepest = DeepestOverlap(part, gripper.FingerBoxes(width), X_PartTool);
  for (int i = 0; i <= kSteps; ++i) {
    const Pose X = X_PartTool * geometry::Translation(0, 0, -length * i / kSteps);
    deepest = std::max(deepest, DeepestOverlap(part, opened, X));
  }
  return deepest;
}

Pose ToolAt(const Pose& X_PartMiddle, const Vector2& center, const Approach& approach) {
  const auto lift = [](const Vector2& v) { return Vector3(v.x(), v.y(), 0); };
  return X_PartMiddle * geometry::PoseFromColumns(lift(approach.x), Vector3::UnitZ(),
                                                  lift(approach.z), lift(center));
}

void ExpectAgreement(const PartModel& part, const Pose& X_PartMiddle, double width,
                     RandomStream& random) {
  const HandClearance clearance(part, ParallelJaw(), X_PartMiddle, width, kAllowance);
  int blocked_count = 0;
  constexpr int kTrials = 80;
  for (int trial = 0; trial < kTrials; ++trial) {
    const double length = random.Uniform(0, 0.1);
    const Approach approach = Approach::At(random.Uniform(0, 2 * std::numbers::pi), length);
    const double y = random.Uniform(-0.12, 0.2);
    const Vector2 center(random.Uniform(-0.12, 0.2), y);
    const auto obstacles = clearance.ObstaclesOf(approach);
    const bool blocked = std::ranges::any_of(
        obstacles, [&](const CObstacle& obstacle) { return obstacle.Contains(center); });
    const double deepest =
        DeepestOnTheWay(part, width, ToolAt(X_PartMiddle, center, approach), length);
    if (blocked) {
      EXPECT_GT(deepest, -0.002) << part.name() << ", seed " << kSeed << " trial " << trial;
    } else {
      EXPECT_LT(deepest, 2 * kAllowance) << part.name() << ", seed " << kSeed << " trial " << trial;
    }
    blocked_count += blocked ? 1 : 0;
  }
  EXPECT_GT(blocked_count, kTrials / 20);
  EXPECT_LT(blocked_count, kTrials);
}

TEST(HandClearanceTest, AgreesWithStepsAlongTheWayIn) {
  RandomStream random(kSeed, "way in");
  const auto peg = LoadPart("peg");
  // The grasps are across the shaft, across the plate, and from base to shoulder.
  ExpectAgreement(*peg, Pose::Identity(), 1.5 * kInch, random);
  ExpectAgreement(*peg, geometry::RotationX(std::numbers::pi / 2), 3 * kInch, random);
  ExpectAgreement(
      *peg, geometry::Translation(-kInch / 2, 0, 0) * geometry::RotationY(std::numbers::pi / 2),
      kInch, random);
  const auto block = LoadPart("block");
  ExpectAgreement(*block, geometry::RotationX(std::numbers::pi / 2), 3 * kInch, random);
}

TEST(HandClearanceTest, IsExactForPartBoxesAtOddAngles) {
  RandomStream random(kSeed, "octagon");
  const auto part = ParsePart(OctagonalPeg());
  ExpectAgreement(*part, Pose::Identity(), 0.04, random);
  ExpectAgreement(*part, geometry::RotationX(45 * kDegree), 0.04, random);
}

TEST(HandClearanceTest, ApproachAxesAreRightHanded) {
  for (double angle : {0.0, 0.3, 2.0, -1.0}) {
    const Approach approach = Approach::At(angle, 0.1);
    const Vector3 x(approach.x.x(), approach.x.y(), 0), z(approach.z.x(), approach.z.y(), 0);
    EXPECT_LT((x.cross(Vector3::UnitZ()) - z).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace assay::domain::hand_clearance_test
