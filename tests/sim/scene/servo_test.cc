#include "sim/scene/servo.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <cmath>

#include "tests/sim/scene/peg_and_block.h"
#include "tests/sim/scene/reach.h"

namespace assay::scene::servo_test {
namespace {

constexpr double kLoad = 1.2 * 9.81;  // newtons

class ServoAt : public testing::TestWithParam<double> {
 protected:
  void Follow(const JointVector& q, const JointVector& qd) {
    servo.Command(data, {q, qd});
    data.Step();
  }

  domain::Problem problem = ProblemWith({});
  Scene scene{problem, {.timestep = GetParam()}};
  mujoco::Data data = scene.Start();
  JointServo servo{scene};
  double dt = GetParam();
};

TEST_P(ServoAt, ALoadMovesTheToolByLessThanATwentiethOfAMillimetre) {
  for (const auto& [x, y, z] : {std::array{0.5, 0.2, 0.1}, {0.9, -0.3, 0.15}, {0.7, 0.0, 0.3}}) {
    const Pose wanted = ToolDown(x, y, z);
    const JointVector q = JointsFor(*problem.workcell, wanted);
    scene.SetArm(data, q);
    data.get()->xfrc_applied[6 * scene.hand().index() + 2] = -kLoad;
    for (double t = 0; t < 1; t += dt) Follow(q, JointVector::Zero());
    EXPECT_LT((scene.ToolPose(data).translation() - wanted.translation()).norm(), 5e-5)
        << "at " << x << " " << y << " " << z;
    EXPECT_LT(scene.ArmVelocity(data).norm(), 1e-6);
  }
}

// A push aside turns joint 1. The motor resists up to its limit of 2000 N m, and no more.
TEST_P(ServoAt, AMotorResistsUpToItsLimit) {
  for (const double share : {0.9, 1.5}) {
    mujoco::Data pushed = scene.Start();
    const JointVector q = JointsFor(*problem.workcell, ToolDown(0.7, 0, 0.3));
    scene.SetArm(pushed, q);
    const Vector3 arm =
        scene.ToolPose(pushed).translation() - problem.workcell->X_WorldBase().translation();
    const double force = share * scene.efforts()[0] / arm.head<2>().norm();
    for (double t = 0; t < 0.1; t += dt) {
      for (auto& applied : pushed.qfrc_applied()) applied = 0;
      servo.Command(pushed, {q, JointVector::Zero()});
      pushed.AddForce(scene.hand(), scene.ToolPose(pushed).translation(), {0, force, 0});
      pushed.Step();
    }
    const double turned = std::abs(scene.ArmPosition(pushed)[0] - q[0]);
    if (share < 1) {
      EXPECT_LT(turned, 2 * force * arm.norm() / scene.servos()[0].stiffness);
    } else {
      EXPECT_GT(turned, 0.05);
    }
  }
}

TEST_P(ServoAt, APushDiesOut) {
  const JointVector q = JointsFor(*problem.workcell, ToolDown(0.6, 0.1, 0.2));
  scene.SetArm(data, q);
  for (int i = 0; i < 6; ++i) data.qvel()[scene.arm().dof[i]] = i % 2 == 0 ? 0.5 : -0.5;
  double largest = 0;
  for (double t = 0; t < 0.5; t += dt) {
    Follow(q, JointVector::Zero());
    largest = std::max(largest, (scene.ArmPosition(data) - q).norm());
  }
  EXPECT_LT(largest, 0.02);
  EXPECT_LT((scene.ArmPosition(data) - q).norm(), 1e-5);
  EXPECT_THAT(data.Warnings(), testing::IsEmpty());
}

TEST_P(ServoAt, AMotionAtConstantSpeedDoesNotLag) {
  const JointVector start = JointsFor(*problem.workcell, ToolDown(0.6, 0.1, 0.3));
  const JointVector speed = (JointVector() << 0.2, 0.1, -0.1, 0.3, 0.1, 0.5).finished();
  scene.SetArm(data, start);
  double error = 0;
  for (int i = 0; i * dt < 1; ++i) {
    const double ramp = std::min(1.0, i * dt / 0.2);  // a soft start
    const double phase = i * dt < 0.2 ? i * dt * ramp / 2 : i * dt - 0.1;
    const JointVector q = start + phase * speed;
    Follow(q, ramp * speed);
    // The arm reaches a command at the start of the step. At its end, the next command is due.
    if (i * dt > 0.6) {
      error = std::max(error, (scene.ArmPosition(data) - q - dt * speed).cwiseAbs().maxCoeff());
    }
  }
  EXPECT_LT(error, 1.1 * dt * speed.cwiseAbs().maxCoeff() + 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Timesteps, ServoAt, testing::Values(0.0005, 0.002),
                         [](const auto& timestep) {
                           return timestep.param < 0.001 ? "half_millisecond" : "two_milliseconds";
                         });

}  // namespace
}  // namespace assay::scene::servo_test
