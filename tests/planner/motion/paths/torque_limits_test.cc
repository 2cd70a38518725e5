#include "planner/motion/paths/torque_limits.h"

#include <gtest/gtest.h>

#include "planner/base/random.h"
#include "planner/geometry/pose.h"
#include "tests/planner/motion/arm_scene.h"

namespace assay::motion::torque_limits_test {
namespace {

using kinematics::ArmDynamics;

constexpr std::uint64_t kSeed = 31;

// Returns the robot of the scene with motors of these torques, newton metres.
domain::Robot WithMotors(const JointVector& efforts) {
  kinematics::RobotModel model = Clutter().workcell->arm().model();
  for (std::size_t i = 0; i < 6; ++i) {
    model.joints[i].limits.effort = efforts[static_cast<int>(i)];
  }
  domain::Robot robot = Clutter().workcell->robot();
  robot.arm = std::make_shared<const kinematics::Arm>(kinematics::Arm::FromModel(model));
  return robot;
}

kinematics::Inertial Load() {
  return {.mass = 2,
          .X_LinkCenter = geometry::Translation(0, 0.03, 0.05),
          .inertia = 0.003 * geometry::Matrix3::Identity()};
}

// Returns the greatest torque of each joint along a trajectory, sampled in time.
JointVector GreatestTorques(const JointTrajectory& way, const domain::Robot& robot,
                            const ArmDynamics& dynamics) {
  constexpr double kInstant = 1e-4;  // seconds
  JointVector greatest = JointVector::Zero();
  for (double t = kInstant; t < way.duration(); t += 3 * kInstant) {
    const auto& [q, qd] = way.At(t);
    const JointVector qdd = (way.At(t + kInstant).qd - way.At(t - kInstant).qd) / (2 * kInstant);
    JointVector torques = dynamics.Torques({q, qd, qdd});
    for (int j = 0; j < 6; ++j) {
      torques[j] += robot.servos[static_cast<std::size_t>(j)].armature * qdd[j];
    }
    greatest = greatest.cwiseMax(torques.cwiseAbs());
  }
  return greatest;
}

TEST(TorqueLimits, AMotionTakesNoMoreThanTheMotorsHave) {
  RandomStream random(kSeed, "torque limits");
  const JointVector home = Clutter().workcell->home();
  const JointVector acceleration = Clutter().workcell->joint_acceleration();
  JointRates rates = RatesOf(*Clutter().workcell);
  int slowed = 0;
  for (int i = 0; i < 20; ++i) {
    JointVector turn;
    for (double& joint : turn) joint = random.Uniform(-0.8, 0.8);
    JointVector efforts;
    efforts << 60, 320, 120, 30, 25, 20;
    const domain::Robot robot = WithMotors(random.Uniform(1, 2) * efforts);
    rates.acceleration = random.Uniform(0.2, 4) * acceleration;
    const JointTrajectory asked = SynchronizedMove(home, home + turn, rates);
    const auto way = WithinTorques(asked, robot, Load());
    ASSERT_TRUE(way) << "seed " << kSeed << ", case " << i;
    kinematics::Inertial load = Load();
    load.X_LinkCenter = robot.gripper->X_FlangeTool() * load.X_LinkCenter;
    const ArmDynamics dynamics =
        ArmDynamics(*robot.arm, *robot.gripper, {0, 0, -9.81}).Carrying(load);
    const JointVector torques = GreatestTorques(*way, robot, dynamics);
    bool near_limit = false;
    for (int j = 0; j < 6; ++j) {
      const double effort = robot.arm->limits()[static_cast<std::size_t>(j)].effort;
      EXPECT_LE(torques[j], effort) << "joint " << j + 1 << ", seed " << kSeed << ", case " << i;
      near_limit = near_limit || torques[j] > 0.9 * effort;
    }
    EXPECT_EQ(way->At(way->duration()).q, asked.At(asked.duration()).q);
    if (way->duration() == asked.duration()) continue;
    ++slowed;
    EXPECT_TRUE(near_limit) << "slower than it has to be: seed " << kSeed << ", case " << i;
  }
  EXPECT_GE(slowed, 5);
  EXPECT_LT(slowed, 20);
}

TEST(TorqueLimits, UnknownTorquesLimitNothing) {
  const JointVector home = Clutter().workcell->home();
  const JointTrajectory asked =
      SynchronizedMove(home, home + JointVector::Constant(0.3), RatesOf(*Clutter().workcell));
  const auto way = WithinTorques(asked, WithMotors(JointVector::Zero()), std::nullopt);
  ASSERT_TRUE(way);
  EXPECT_EQ(way->duration(), asked.duration());
}

TEST(TorqueLimits, WeakMotorsCannotCarryTheArm) {
  const JointVector home = Clutter().workcell->home();
  const JointTrajectory asked =
      SynchronizedMove(home, home + JointVector::Constant(0.3), RatesOf(*Clutter().workcell));
  EXPECT_FALSE(WithinTorques(asked, WithMotors(JointVector::Constant(20)), std::nullopt));
}

}  // namespace
}  // namespace assay::motion::torque_limits_test
