#include "planner/motion/handling/carry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/domain/resting/resting.h"
#include "planner/geometry/pose.h"
#include "planner/motion/collision/motion_check.h"
#include "planner/motion/paths/straight_line.h"
#include "tests/planner/motion/handling/cans.h"

namespace assay::motion::carry_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class Carry : public testing::Test {
 protected:
  TravelResult Plan(std::optional<double> tilt = {}) const {
    return PlanCarry(Cans(), around_, {.from = home_, .table = SecondTable(), .tilt = tilt});
  }
  JointPath Found(std::optional<double> tilt = {}) const {
    const TravelResult result = Plan(tilt);
    if (const auto* why = std::get_if<std::string>(&result)) {
      ADD_FAILURE() << *why;
      return {home_};
    }
    return std::get<JointPath>(result);
  }
  Pose HeldAt(const JointVector& q) const {
    return ToolAt(*Cans().workcell, q) * kFromAbove.inverse();
  }
  // Calls `look` with postures along the path that are a hundredth of a radian apart.
  static void Along(const JointPath& path, const auto& look) {
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const JointVector way = path[i + 1] - path[i];
      const int steps = 1 + static_cast<int>(way.cwiseAbs().maxCoeff() / 0.01);
      for (int k = 0; k <= steps; ++k) look(JointVector(path[i] + k * way / steps));
    }
  }

  const JointVector home_ = Cans().workcell->home();
  Surroundings around_ = CanInTheHand();
};

TEST_F(Carry, LeadsOverTheTableWithoutTouchingAnything) {
  const JointPath path = Found();
  EXPECT_TRUE(path.front() == home_);
  const Pose held = HeldAt(path.back());
  EXPECT_TRUE(domain::IsOver(SecondTable(), Cans().part(kCan), held));
  EXPECT_TRUE(Cans().workcell->arm().InRange(path.back()));
  const CollisionScene scene(Cans(), around_);
  Along(path, [&](const JointVector& q) { EXPECT_GE(scene.Nearest(q).distance, 0.015); });
}

// The arm follows the straight lines down to the table and up again without changing its
// configuration.
TEST_F(Carry, EndsWhereThePartCanBeLoweredStraight) {
  const JointPath path = Found();
  const Vector3 tool = ToolAt(*Cans().workcell, path.back()).translation();
  const Vector3 placed(tool.x(), tool.y(), 0.09);
  EXPECT_TRUE(FollowLines(*Cans().workcell, path.back(), {placed, tool}, kLineStep));
}

// The held can has room at the middle of the table, but the forearm has no room above the post.
TEST_F(Carry, LeavesRoomForTheArm) {
  around_.parts.back().X_WorldPart.translation() << 0.45, 0.32, 0;
  const JointPath path = Found();
  const auto lines = FollowLines(
      *Cans().workcell, path.back(),
      {Vector3(ToolAt(*Cans().workcell, path.back()).translation() - Vector3(0, 0, 0.3))}, 0.02);
  ASSERT_TRUE(lines);
  const CollisionScene scene(Cans(), around_);
  MotionCheck arm(scene, {.clearance = kTravelGap, .bodies = MotionRules::Bodies::kArm});
  for (std::size_t i = 0; i + 1 < lines->size(); ++i) {
    EXPECT_FALSE(arm.FindObstruction((*lines)[i], (*lines)[i + 1]));
  }
}

TEST_F(Carry, KeepsThePartAsUprightAsAsked) {
  const double tilt = 5 * M_PI / 180;
  Along(Found(tilt), [&](const JointVector& q) {
    EXPECT_LE(std::acos(std::min(1.0, HeldAt(q).linear()(2, 2))), tilt + 1e-9);
  });
}

// With an error of the hand the tool is believed to be elsewhere, and the part with it.
TEST_F(Carry, TakesTheHandsErrorIntoAccount) {
  const Pose error = geometry::Translation(0, 0, 0.002);
  const TravelResult result =
      PlanCarry(Cans(), around_, {.from = home_, .table = SecondTable(), .X_BelievedTool = error});
  ASSERT_TRUE(std::holds_alternative<JointPath>(result)) << std::get<std::string>(result);
  const Pose believed = ToolAt(*Cans().workcell, std::get<JointPath>(result).back()) *
                        error.inverse() * kFromAbove.inverse();
  EXPECT_TRUE(domain::IsOver(SecondTable(), Cans().part(kCan), believed));
}

TEST_F(Carry, NamesThePairThatIsTooNearAtTheStart) {
  around_.parts.front().X_WorldPart = geometry::Translation(0.07, 0, 0) * HeldAt(home_);
  const TravelResult result = Plan();
  ASSERT_TRUE(std::holds_alternative<std::string>(result));
  EXPECT_THAT(std::get<std::string>(result),
              AllOf(HasSubstr("at the start, "), HasSubstr("can1"), HasSubstr("can2"),
                    HasSubstr("nearer than 15.0 mm")));
}

TEST_F(Carry, SaysThatNoPlaceIsFree) {
  const domain::Table narrow{.name = "narrow",
                             .top = {{0.55, 0.35}, {0.65, 0.35}, {0.65, 0.45}, {0.55, 0.45}}};
  around_.parts.front().X_WorldPart.translation() << 0.6, 0.4, 0;
  const TravelResult result = PlanCarry(Cans(), around_, {.from = home_, .table = narrow});
  ASSERT_TRUE(std::holds_alternative<std::string>(result));
  EXPECT_EQ(std::get<std::string>(result), "none is free");
}

}  // namespace
}  // namespace assay::motion::carry_test
