#include "planner/assembly/strategy_reach.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/finemotion/strategy_search/mating.h"
#include "planner/geometry/pose.h"
#include "tests/planner/constraint_posting/scenarios.h"

namespace assay::assembly::strategy_reach_test {
namespace {

using geometry::Pose;
using geometry::Vector3;

// A mating of the square peg that was made by hand. It leads from a leaning pose before the hole to
// a few millimetres before the seat.
class StrategyReachTest : public ::testing::Test {
 protected:
  const domain::Problem problem_ = constraint_posting::LoadScenario("mate-square");
  const plan::Action assemble_ =
      constraint_posting::ActionsOf(constraint_posting::FirstInstance(problem_)).back();
  const domain::Mating& mating_ = problem_.mating(assemble_.mating);
  const finemotion::MatingGeometry geometry_ = finemotion::GeometryOf(problem_, mating_);
  plan::Strategy strategy_ = {.X_HeldTip = geometry_.X_HeldTip,
                              .X_FixedStart = Back(0.09, 0.15),
                              .contacts = {},
                              .motions = {MotionTo(Back(0.08, 0)), MotionTo(Back(0.004, 0))}};

  // Returns a leaning pose of the tip that is `metres` short of its seat.
  Pose Back(double metres, double lean) const {
    Pose X = geometry_.X_FixedSeat;
    X.translation() -= metres * geometry_.passage.mating;
    X.rotate(Eigen::AngleAxisd(lean, geometry_.passage.mating.unitOrthogonal()));
    return X;
  }
  static plan::StrategyMotion MotionTo(const Pose& X_FixedTip) {
    return {.kept = {}, .X_FixedTip = X_FixedTip, .until = {}};
  }
  StrategyReach Reach(const plan::Action& assemble) const {
    return ReachOf(problem_, assemble, strategy_, plan::InitialState(problem_));
  }
  Unreached WhatIsUnreached() const { return std::get<Unreached>(Reach(assemble_)); }
};

TEST_F(StrategyReachTest, ThePlansHoldReaches) {
  EXPECT_TRUE(std::holds_alternative<kinematics::JointVector>(Reach(assemble_)));
  const auto chosen = ChooseHold(problem_, assemble_, strategy_);
  ASSERT_TRUE(std::holds_alternative<ReachingHold>(chosen));
  EXPECT_EQ(std::get<ReachingHold>(chosen).hold.grasp, assemble_.hold.grasp);
}

TEST_F(StrategyReachTest, APoseThatIsTooFarAwayIsTold) {
  strategy_.motions[0].X_FixedTip = Back(1.5, 0);
  EXPECT_EQ(WhatIsUnreached().motion, 1);
  EXPECT_TRUE(WhatIsUnreached().obstacle.IsNone());
  strategy_.X_FixedStart = Back(1.5, 0);
  EXPECT_EQ(WhatIsUnreached().motion, 0);
  const Pose X_WorldTip =
      WhatIsUnreached().X_WorldTool * assemble_.hold.X_PartTool.inverse() * strategy_.X_HeldTip;
  EXPECT_TRUE(X_WorldTip.isApprox(assemble_.place.X_WorldPart * Back(1.5, 0), 1e-9));
}

// If the tip goes beyond the seat by the length of the shaft, the hand collides with the block.
TEST_F(StrategyReachTest, APartInTheHandsWayIsTold) {
  strategy_.motions[1].X_FixedTip = Back(-0.05, 0);
  EXPECT_EQ(WhatIsUnreached().motion, 2);
  EXPECT_EQ(WhatIsUnreached().obstacle, mating_.fixed);
}

TEST_F(StrategyReachTest, AnotherGraspIsTakenWhereTheOwnDoesNotReach) {
  plan::Action wrong = assemble_;
  wrong.hold.grasp = "none";
  wrong.hold.X_PartTool = geometry::Translation(0, 0, 2) * assemble_.hold.X_PartTool;
  ASSERT_TRUE(std::holds_alternative<Unreached>(Reach(wrong)));
  const auto chosen = ChooseHold(problem_, wrong, strategy_);
  ASSERT_TRUE(std::holds_alternative<ReachingHold>(chosen));
  const ReachingHold& reaching = std::get<ReachingHold>(chosen);
  const auto& grasps = *problem_.part(mating_.held).grasps;
  EXPECT_TRUE(std::ranges::any_of(grasps, [&](const domain::Grasp& grasp) {
    return grasp.label == reaching.hold.grasp &&
           grasp.X_PartTool.isApprox(reaching.hold.X_PartTool);
  }));
  const Pose X_WorldTool = assemble_.place.X_WorldPart * strategy_.X_FixedStart *
                           strategy_.X_HeldTip.inverse() * reaching.hold.X_PartTool;
  const domain::Workcell& workcell = *problem_.workcell;
  EXPECT_TRUE(
      workcell.arm().Forward(reaching.start).isApprox(workcell.FlangeFor(X_WorldTool), 1e-6));
}

TEST_F(StrategyReachTest, WhereNoGraspReachesItIsToldOfTheOwn) {
  strategy_.motions[1].X_FixedTip = Back(-0.05, 0);
  const auto chosen = ChooseHold(problem_, assemble_, strategy_);
  ASSERT_TRUE(std::holds_alternative<Unreached>(chosen));
  EXPECT_EQ(std::get<Unreached>(chosen).motion, 2);
}

}  // namespace
}  // namespace assay::assembly::strategy_reach_test
