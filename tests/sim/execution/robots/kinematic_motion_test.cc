#include "sim/execution/robots/kinematic_motion.h"

#include <gtest/gtest.h>

#include "planner/geometry/pose.h"
#include "sim/execution/robots/firm_grip.h"
#include "sim/execution/walk/executor.h"
#include "sim/noise/sampling.h"
#include "tests/sim/execution/figure15.h"

namespace assay::execution::kinematic_motion_test {
namespace {

using geometry::Vector3;

const PartId kNothing = PartId::None();

// The start of figure 15, with the arm at its home.
class AtHome : public testing::Test {
 protected:
  AtHome() : data_(scene_.Start()) {
    for (int i = 0; i < 500; ++i) data_.Step();  // the parts settle
    data_.SetTime(0);
    data_.Step([&] { motion_.SeeForces(data_, kNothing); });
  }

  RobotCommand Here() const {
    return {.arm = {scene_.ArmPosition(data_), kinematics::JointVector::Zero()},
            .opening = scene_.Opening(data_)};
  }

  const domain::Problem problem_ = Figure15();
  const scene::Scene scene_{problem_, {}};
  mujoco::Data data_;
  KinematicMotion motion_{scene_};
};

TEST_F(AtHome, MovesTheRobotAndNothingElse) {
  const Pose before = scene_.TruePose(data_, PartId(0));
  ASSERT_TRUE(motion_.Begin(data_, kNothing, Here()));
  RobotCommand next = Here();
  next.arm.q[0] += 0.01;
  next.arm.qd[0] = 1;
  next.opening -= 0.002;
  ASSERT_TRUE(motion_.MoveTo(next, 0.01, data_));
  motion_.End(data_);
  EXPECT_LT((scene_.ArmPosition(data_) - next.arm.q).norm(), 1e-12);
  EXPECT_EQ(scene_.ArmVelocity(data_)[0], 1);
  EXPECT_NEAR(scene_.Opening(data_), next.opening, 1e-12);
  EXPECT_EQ(data_.time(), 0.01);
  EXPECT_TRUE(scene_.TruePose(data_, PartId(0)).isApprox(before, 0));
}

// Servos that know the whole load lead the arm to where it is commanded.
TEST_F(AtHome, HasNoLag) {
  RobotCommand commanded = Here();
  const kinematics::JointVector q = commanded.arm.q;
  commanded.arm.q[2] -= 1e-4;
  ASSERT_TRUE(motion_.Begin(data_, kNothing, commanded));
  commanded.arm.q[0] += 0.01;
  ASSERT_TRUE(motion_.MoveTo(commanded, 0.01, data_));
  EXPECT_NEAR(scene_.ArmPosition(data_)[0], q[0] + 0.01, 1e-12);
  EXPECT_NEAR(scene_.ArmPosition(data_)[2], q[2] - 1e-4, 1e-12);
}

// A part is where the hand would be after a turn of 0.3 rad.
TEST_F(AtHome, StopsBeforeItTouches) {
  const kinematics::JointVector home = scene_.ArmPosition(data_);
  kinematics::JointVector turned = home;
  turned[0] += 0.3;
  scene_.MoveArm(data_, turned);
  const Pose in_the_way = scene_.ToolPose(data_);
  scene_.MoveArm(data_, home);
  scene_.SetPart(data_, PartId(0), in_the_way);
  ASSERT_TRUE(motion_.Begin(data_, kNothing, Here()));
  RobotCommand next = Here();
  int moved = 0;
  next.arm.q[0] += 0.002;
  while (motion_.MoveTo(next, moved + 1, data_)) {
    ++moved;
    next.arm.q[0] += 0.002;
  }
  EXPECT_GT(moved, 0);
  EXPECT_LT(moved, 150);
  EXPECT_NEAR(scene_.ArmPosition(data_)[0], home[0] + moved * 0.002, 1e-9);
  EXPECT_EQ(data_.time(), moved);
  motion_.End(data_);
  for (const mujoco::Contact& contact : mujoco::Contacts(data_)) {
    EXPECT_NE(scene_.KindOf(contact.body_a), scene::BodyKind::kHand);
    EXPECT_NE(scene_.KindOf(contact.body_b), scene::BodyKind::kHand);
  }
}

// The base stands on the floor. It is no obstacle to the arm's motion that the two touch.
TEST_F(AtHome, MovesWhileTheBaseTouchesTheFloor) {
  const mujoco::GeomId floor = scene_.model().Geom("floor");
  data_.SetGeomHeight(floor, data_.GeomHeight(floor) + 0.001);
  data_.Forward();
  ASSERT_TRUE(motion_.Begin(data_, kNothing, Here()));
  RobotCommand next = Here();
  next.arm.q[0] += 0.01;
  EXPECT_TRUE(motion_.MoveTo(next, 0.01, data_));
}

TEST_F(AtHome, DoesNotBeginWhileAPartFalls) {
  Pose in_the_air = scene_.TruePose(data_, PartId(0));
  in_the_air.translation().z() += 0.05;
  scene_.SetPart(data_, PartId(0), in_the_air);
  for (int i = 0; i < 10; ++i) data_.Step();
  EXPECT_FALSE(motion_.Begin(data_, kNothing, Here()));
}

TEST_F(AtHome, NothingStandsThatMovesSlowly) {
  EXPECT_TRUE(motion_.EverythingStands(data_));
  const scene::Twist slow = {.linear = {2e-5, 0, 0}, .angular = Vector3::Zero()};
  scene_.SetPartTwist(data_, PartId(0), slow);
  EXPECT_FALSE(motion_.EverythingStands(data_));
  scene_.SetPartTwist(data_, PartId(0), {});
  EXPECT_TRUE(motion_.EverythingStands(data_));
  scene_.SetVelocity(data_, kinematics::JointVector::Constant(1e-3), 0);
  EXPECT_FALSE(motion_.EverythingStands(data_));
  scene_.SetVelocity(data_, kinematics::JointVector::Zero(), 1e-3);
  EXPECT_FALSE(motion_.EverythingStands(data_));
}

TEST_F(AtHome, GoesOnLongerWhereNothingIsNear) {
  ASSERT_TRUE(motion_.Begin(data_, kNothing, Here()));
  RobotCommand next = Here();
  next.arm.q[0] += 1e-4;
  next.arm.qd[0] = 0.1;
  const double at_first = motion_.MayGoOn(next);
  ASSERT_TRUE(motion_.MoveTo(next, 0.001, data_));
  EXPECT_GT(motion_.MayGoOn(next), 10 * at_first);
}

TEST_F(AtHome, DoesNotBeginBeforeItHasSeenForces) {
  motion_.Forget();
  EXPECT_FALSE(motion_.Begin(data_, kNothing, Here()));
}

// The pads hold the peg by friction. Its weight is varied: the load of the friction is the weight,
// and what it can bear is the friction of the contacts times their pressure.
class PegInHand : public Figure15Test {
 protected:
  // Returns the share of the friction that the peg's weight uses, and whether the grip is firm,
  // after the pickup of a peg of this mass.
  struct Grip {
    double share = 0;
    bool is_firm = false;
  };
  static Grip WithMass(double mass) {
    scene::SceneOptions options;
    const PartId peg = problem().mating(domain::MatingId(0)).held;
    options.part_masses[peg] = mass;
    const scene::Scene scene(problem(), options);
    mujoco::Data data = scene.Start();
    ExecutorOptions until_pickup;
    until_pickup.last = plan::StepId(1);
    Execute(problem(), plan(), scene, data, until_pickup);
    data.Forward();
    double most = 0;
    for (const mujoco::BodyId finger : {scene.left_finger(), scene.right_finger()}) {
      for (const auto& contact : mujoco::ContactsBetween(data, finger, scene.Body(peg))) {
        most += contact.friction * contact.force_on_b.dot(contact.normal);
      }
    }
    return {mass * scene::kGravity / most, IsFirm(scene, data, peg)};
  }
};

TEST_F(PegInHand, IsFirmIfFrictionCouldBearTwiceTheWeight) {
  const Grip light = WithMass(0.1);
  ASSERT_LT(light.share, 0.25);
  EXPECT_TRUE(light.is_firm);
  const double half = 0.1 / (2 * light.share);  // the mass whose weight uses half of the friction
  const Grip heavy = WithMass(1.2 * half);
  ASSERT_GT(heavy.share, 0.55);
  EXPECT_FALSE(heavy.is_firm);
}

// Full dynamics are the oracle.
class AgainstDynamics : public Figure15Test {
 protected:
  static Trace Run(double kinematic_step, const noise::Noise& drawn,
                   const scene::SceneOptions& options) {
    const scene::Scene scene(problem(), options);
    mujoco::Data data = StartOf(problem(), scene, drawn);
    return Execute(problem(), plan(), scene, data,
                   {.kinematic_step = kinematic_step, .noise = drawn});
  }
  // Draws errors that are small enough for the plan to succeed.
  static noise::Noise Drawn(int trial) {
    domain::Problem with_small_errors = problem();
    for (domain::Part& part : with_small_errors.parts) {
      for (Interval* range : {&part.error.x, &part.error.y, &part.error.z, &part.error.theta}) {
        *range = {-3e-4, 3e-4};
      }
    }
    return noise::Sample(with_small_errors, noise::ErrorBox(with_small_errors, plan()),
                         noise::Mode::kUniform, 7, trial);
  }
};

// With full dynamics a held part creeps in the pads, by less than 0.1 mm here.
TEST_F(AgainstDynamics, TrialsEndAlike) {
  for (int trial = 1; trial <= 2; ++trial) {
    const Trace quick = Run(0.002, Drawn(trial), {});
    const Trace full = Run(0, Drawn(trial), {});
    EXPECT_LT(2 * quick.end().steps, full.end().steps);
    ASSERT_EQ(full.end().outcome, TrialOutcome::kSucceeded) << full.end().reason;
    ASSERT_EQ(quick.end().outcome, TrialOutcome::kSucceeded) << quick.end().reason;
    EXPECT_NEAR(quick.All<GraspFact>()[0]->opening, full.All<GraspFact>()[0]->opening, 5e-6);
    const auto quick_ends = quick.All<StepEnd>();
    const auto full_ends = full.All<StepEnd>();
    ASSERT_EQ(quick_ends.size(), full_ends.size());
    for (std::size_t i = 0; i < quick_ends.size(); ++i) {
      for (std::size_t p = 0; p < problem().parts.size(); ++p) {
        const Pose& a = quick_ends[i]->snapshot.parts[p].truth;
        const Pose& b = full_ends[i]->snapshot.parts[p].truth;
        EXPECT_LT((a.translation() - b.translation()).norm(), 1e-4) << trial << " " << i;
        EXPECT_LT(geometry::AngleBetween(a.linear(), b.linear()), 5e-4) << trial << " " << i;
      }
    }
  }
}

// Pads without enough friction lose the peg, with and without dynamics.
TEST_F(AgainstDynamics, APartThatSlipsOutDoesSo) {
  const scene::SceneOptions slippery = {
      .part_masses = {{peg(), 5}}, .friction_error = -0.45, .pad_friction_error = -0.45};
  for (const double kinematic_step : {0.0, 0.002}) {
    const Trace trace = Run(kinematic_step, {}, slippery);
    const TrueAndBelieved& lifted = trace.All<StepEnd>()[0]->snapshot.parts[peg().index()];
    EXPECT_GT((lifted.truth.translation() - lifted.believed.translation()).norm(), 0.01);
  }
}

}  // namespace
}  // namespace assay::execution::kinematic_motion_test
