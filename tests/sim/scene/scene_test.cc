#include "sim/scene/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include "planner/base/random.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/mass_properties.h"
#include "sim/scene/servo.h"
#include "tests/sim/scene/peg_and_block.h"
#include "tests/sim/scene/reach.h"

namespace assay::scene::scene_test {
namespace {

using geometry::AngleBetween;

JointVector AnyJoints(const kinematics::Arm& arm, RandomStream& random) {
  JointVector q;
  for (int i = 0; i < 6; ++i) q[i] = random.Uniform(arm.limits()[i].lower, arm.limits()[i].upper);
  return q;
}

void ExpectNear(const Pose& a, const Pose& b, double metres, double radians) {
  EXPECT_LT((a.translation() - b.translation()).norm(), metres);
  EXPECT_LT(AngleBetween(a.linear(), b.linear()), radians);
}

TEST(Scene, TheEnginesArmIsThePlannersArm) {
  const domain::Problem problem = PegAndBlock();
  const Scene scene(problem, {});
  mujoco::Data data = scene.Start();
  const domain::Workcell& workcell = *problem.workcell;
  RandomStream random(11, "joints");
  for (int i = 0; i < 100; ++i) {
    const JointVector q = AnyJoints(workcell.arm(), random);
    scene.SetArm(data, q);
    EXPECT_EQ(scene.ArmPosition(data), q);
    const Pose expected =
        workcell.X_WorldBase() * workcell.arm().Forward(q) * workcell.gripper().X_FlangeTool();
    ExpectNear(scene.ToolPose(data), expected, 1e-9, 1e-7);
  }
}

TEST(Scene, PartsAreWhereTheProblemSays) {
  const domain::Problem problem = PegAndBlock();
  const Scene scene(problem, {});
  const mujoco::Data data = scene.Start();
  ExpectNear(scene.TruePose(data, kBlock), problem.part(kBlock).X_WorldPart, 1e-12, 1e-7);
  ExpectNear(scene.TruePose(data, kPeg), problem.part(kPeg).X_WorldPart, 1e-12, 1e-7);
  const double mass = data.own_model()->body_mass[scene.Body(kBlock).index()];
  EXPECT_NEAR(mass, problem.part(kBlock).model->mass().mass, 1e-12);
}

TEST(Scene, SetPartMovesThatPart) {
  const domain::Problem problem = PegAndBlock();
  const Scene scene(problem, {});
  mujoco::Data data = scene.Start();
  const Pose X =
      geometry::Translation(0.6, 0.1, 0.5) * geometry::RotationX(1) * geometry::RotationZ(2);
  scene.SetPart(data, kPeg, X);
  ExpectNear(scene.TruePose(data, kPeg), X, 1e-12, 1e-7);
  ExpectNear(scene.TruePose(data, kBlock), problem.part(kBlock).X_WorldPart, 1e-12, 1e-7);
}

TEST(Scene, PartsAtRestStay) {
  const domain::Problem problem = PegAndBlock();
  for (const double timestep : {0.0005, 0.002}) {
    const Scene scene(problem, {.timestep = timestep});
    mujoco::Data data = scene.Start();
    for (double t = 0; t < 1; t += timestep) data.Step();
    for (const domain::PartId part : {kBlock, kPeg}) {
      ExpectNear(scene.TruePose(data, part), problem.part(part).X_WorldPart, 2e-5, 2e-4);
      EXPECT_TRUE(scene.Touching(data, part, scene.world()));
    }
    EXPECT_THAT(data.Warnings(), testing::IsEmpty());
  }
}

TEST(Scene, AnAssembledPairTouchesOutsideTheHoleOnly) {
  domain::Problem problem = PegAndBlock();
  const Pose X_BlockPeg =
      geometry::PoseFromColumns({-1, 0, 0}, {0, 1, 0}, {0, 0, -1}, Vector3(3, 0, 3.25) * kInch);
  problem.parts[0] = PartAt({"block", "on-back", 0.6, 0.0, 0.3}, problem.clearance);
  problem.parts[1].X_WorldPart = problem.parts[0].X_WorldPart * X_BlockPeg;
  const Scene scene(problem, {});
  mujoco::Data data = scene.Start();
  for (int i = 0; i < 1000; ++i) data.Step();
  EXPECT_TRUE(scene.Touching(data, kPeg, scene.Body(kBlock)));
  const Pose now = scene.TruePose(data, kBlock).inverse() * scene.TruePose(data, kPeg);
  ExpectNear(now, X_BlockPeg, 1e-5, 1e-4);
  const Pose X_BlockWorld = scene.TruePose(data, kBlock).inverse();
  for (const auto& contact : mujoco::ContactsBetween(data, scene.Body(kBlock), scene.Body(kPeg))) {
    EXPECT_GT(contact.distance, -1e-5);
    EXPECT_NEAR((X_BlockWorld * contact.position).x(), 3 * kInch, 1e-5);  // at the mouth's face
  }
}

TEST(Scene, TheGripperOpensAndCloses) {
  const domain::Problem problem = PegAndBlock();
  const Scene scene(problem, {});
  mujoco::Data data = scene.Start();
  EXPECT_NEAR(scene.Opening(data), scene.max_opening(), 1e-9);
  scene.CommandGripper(data, 0.03);
  for (int i = 0; i < 4000; ++i) data.Step();
  EXPECT_NEAR(scene.Opening(data), 0.03, 2e-4);
  EXPECT_NEAR(scene.OpeningSpeed(data), 0, 1e-4);
  scene.CommandGripper(data, 1);
  for (int i = 0; i < 4000; ++i) data.Step();
  EXPECT_NEAR(scene.Opening(data), scene.max_opening(), 2e-4);
  scene.SetGripper(data, 0.05);
  EXPECT_NEAR(scene.Opening(data), 0.05, 1e-12);
}

// A part between the pads in the air, held by friction alone.
class Held : public testing::Test {
 protected:
  Held() {
    scene.SetArm(data, q);
    scene.SetPart(data, kBlock, scene.ToolPose(data) * X_ToolBlock);
    scene.SetGripper(data, 3 * kInch + 0.002);
    scene.CommandGripper(data, 0);
  }

  void Hold(double seconds) {
    for (double t = 0; t < seconds; t += scene.options().timestep) {
      servo.Command(data, {q, JointVector::Zero()});
      data.Step();
    }
  }

  // The pads close across the block's y, and the tool points along its x. The fingers reach 20 mm
  // deep.
  Pose X_ToolBlock =
      geometry::Translation(0, 0, -0.02) *
      geometry::PoseFromColumns({0, 0, 1}, {0, 1, 0}, {-1, 0, 0}, {3.25 * kInch, 0, 0});
  domain::Problem problem = PegAndBlock();
  Scene scene{problem, {}};
  mujoco::Data data = scene.Start();
  JointServo servo{scene};
  JointVector q = JointsFor(*problem.workcell, ToolDown(0.6, 0.1, 0.35));
};

TEST_F(Held, ByTheGripForce) {
  Hold(1.5);
  EXPECT_NEAR(scene.Opening(data), 3 * kInch, 2e-5);
  for (const mujoco::BodyId finger : {scene.left_finger(), scene.right_finger()}) {
    double force = 0;
    for (const auto& c : mujoco::ContactsBetween(data, finger, scene.Body(kBlock))) {
      force += c.force_on_b.dot(c.normal);
    }
    EXPECT_NEAR(force, problem.workcell->rules().grip_force, 1.0);
  }
  const Pose before = scene.ToolPose(data).inverse() * scene.TruePose(data, kBlock);
  Hold(2);
  const Pose after = scene.ToolPose(data).inverse() * scene.TruePose(data, kBlock);
  ExpectNear(before, after, 5e-5, 5e-4);  // creep
}

TEST_F(Held, TheWristFeelsTheLoad) {
  scene.SetPart(data, kBlock, geometry::Translation(0.9, -0.4, 0.1));
  scene.CommandGripper(data, 1);
  Hold(1.5);
  EXPECT_LT(scene.WristWrench(data).force.norm(), 0.01);
  EXPECT_LT(scene.WristWrench(data).torque.norm(), 0.01);

  scene.SetPart(data, kBlock, scene.ToolPose(data) * X_ToolBlock);
  scene.SetGripper(data, 3 * kInch + 0.0005);
  scene.CommandGripper(data, 0);
  Hold(2);
  const auto& mass = problem.part(kBlock).model->mass();
  const Vector3 weight(0, 0, -9.81 * mass.mass);
  const Pose X_WorldFlange =
      scene.ToolPose(data) * problem.workcell->gripper().X_FlangeTool().inverse();
  const Vector3 arm = scene.TruePose(data, kBlock) * mass.center - X_WorldFlange.translation();
  const Wrench wrench = scene.WristWrench(data);
  EXPECT_LT((wrench.force - weight).norm(), 0.02 * weight.norm());
  EXPECT_LT((wrench.torque - arm.cross(weight)).norm(), 0.01);
}

TEST(Scene, AttachedPartsFollowTheToolAndDetachedOnesFall) {
  const domain::Problem problem = PegAndBlock();
  const Scene scene(problem, {.grasp = GraspMode::kWeld});
  mujoco::Data data = scene.Start();
  const JointServo servo(scene);
  const JointVector q = JointsFor(*problem.workcell, ToolDown(0.6, 0.1, 0.4));
  scene.SetArm(data, q);
  // The peg is below the pads, where nothing touches it.
  const Pose X_ToolPeg = geometry::Translation(0, 0, 0.06);
  scene.SetPart(data, kPeg, scene.ToolPose(data) * X_ToolPeg);
  scene.AttachPart(data, kPeg);
  const auto hold = [&](int steps) {
    for (int i = 0; i < steps; ++i) {
      servo.Command(data, {q, JointVector::Zero()});
      data.Step();
    }
  };
  hold(2000);
  ExpectNear(scene.ToolPose(data).inverse() * scene.TruePose(data, kPeg), X_ToolPeg, 1e-5, 1e-4);
  scene.DetachPart(data, kPeg);
  hold(100);
  EXPECT_NEAR(scene.TrueTwist(data, kPeg).linear.z(), -9.81 * 0.05, 0.01);
}

TEST(Scene, PartFrictionCanBeReplaced) {
  const domain::Problem problem = PegAndBlock();
  const std::string mjcf = ToMjcf(problem, {.part_friction = 0.6});
  EXPECT_THAT(mjcf, testing::HasSubstr("friction=\"0.6 "));
  EXPECT_THAT(ToMjcf(problem, {}), testing::Not(testing::HasSubstr("friction=\"0.6 ")));
}

}  // namespace
}  // namespace assay::scene::scene_test
