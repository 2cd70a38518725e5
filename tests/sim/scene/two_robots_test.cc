#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include "planner/domain/problem/problem_file.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/mass_properties.h"
#include "sim/scene/scene.h"
#include "sim/scene/servo.h"

namespace assay::scene::two_robots_test {
namespace {

constexpr PartId kBottle(0);
constexpr domain::RobotId kLeft(0);
constexpr domain::RobotId kRight(1);

domain::Problem Bottle() {
  return domain::ReadProblem(
      Document::Parse("format: assay-scenario/1\n"
                      "workcell: two-pumas\n"
                      "parts:\n"
                      "  bottle: {model: bottle, pose: {stable: upright, at: [-0.4, 0.1]}}\n"
                      "goal: [{located: {part: bottle, stable: [upright]}}]\n",
                      "bottle.yaml"),
      ASSAY_SOURCE_DIR "/models");
}

Pose ToolAt(const domain::Workcell& workcell, const JointVector& q) {
  return workcell.X_WorldBase() * workcell.arm().Forward(q) * workcell.gripper().X_FlangeTool();
}

class TwoRobots : public testing::TestWithParam<domain::RobotId> {
 protected:
  // Returns the number of a part's contacts at the start. All of them are with its table.
  int CountOf(PartId part) const {
    return static_cast<int>(
        mujoco::ContactsBetween(first_.Start(), first_.Body(part), first_.world()).size());
  }
  domain::RobotId Other() const { return GetParam() == kLeft ? kRight : kLeft; }

  const domain::Problem problem_ = Bottle();
  const Scene first_{problem_, {}};
  const Scene scene_ = first_.WorkedBy(GetParam());
  const Scene other_ = first_.WorkedBy(Other());
  const std::shared_ptr<const domain::Workcell> workcell_ = problem_.workcell->WorkedBy(GetParam());
  mujoco::Data data_ = first_.Start();
};
INSTANTIATE_TEST_SUITE_P(Scene, TwoRobots, testing::Values(kLeft, kRight),
                         [](const auto& robot) { return robot.param == kLeft ? "Left" : "Right"; });

TEST_P(TwoRobots, StartAtTheirHomes) {
  EXPECT_EQ(scene_.ArmPosition(data_), workcell_->home());
  EXPECT_EQ(scene_.Opening(data_), workcell_->gripper().max_opening());
  EXPECT_TRUE(scene_.ToolPose(data_).isApprox(ToolAt(*workcell_, workcell_->home()), 1e-9));
}

TEST_P(TwoRobots, OnlyTheOneThatActsIsSet) {
  const JointVector q = workcell_->home() + JointVector::Constant(0.1);
  scene_.SetArm(data_, q);
  scene_.SetGripper(data_, 0.03);
  EXPECT_TRUE(scene_.ToolPose(data_).isApprox(ToolAt(*workcell_, q), 1e-9));
  EXPECT_NEAR(scene_.Opening(data_), 0.03, 1e-12);
  EXPECT_EQ(other_.ArmPosition(data_), workcell_->WorkedBy(Other())->home());
  EXPECT_EQ(other_.Opening(data_), other_.max_opening());
}

// The servos of the resting robot hold it, whatever the other robot does.
TEST_P(TwoRobots, TheOneThatRestsStaysAtItsHome) {
  const JointServo servo(scene_);
  const JointVector home = workcell_->home();
  const JointVector sway = 0.3 * JointVector::Ones();
  const auto at = [&](double t) { return JointVector(home + std::sin(4 * t) * sway); };
  for (double t = 0; t < 1; t += data_.timestep()) {
    servo.Command(data_, {at(t), 4 * std::cos(4 * t) * sway}, -16 * std::sin(4 * t) * sway, {});
    data_.Step();
  }
  EXPECT_LT((scene_.ArmPosition(data_) - at(1)).cwiseAbs().maxCoeff(), 2e-3);
  const JointVector rest = workcell_->WorkedBy(Other())->home();
  EXPECT_LT((other_.ArmPosition(data_) - rest).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_FALSE(data_.HasWarnings());
}

TEST_P(TwoRobots, TheWristFeelsWhatItsOwnHandHolds) {
  const Pose X_WorldPart =
      scene_.ToolPose(data_) * geometry::RotationX(M_PI) * geometry::Translation(0, 0, -0.14);
  scene_.SetPart(data_, kBottle, X_WorldPart);
  scene_.CommandGripper(data_, 0);
  scene_.Clamp(data_, kBottle, -problem_.part(kBottle).model->mass().mass * kGravity);
  for (double t = 0; t < 0.8; t += data_.timestep()) data_.Step();
  scene_.Clamp(data_, kBottle, 0);
  for (double t = 0; t < 0.5; t += data_.timestep()) data_.Step();
  const double weight = problem_.part(kBottle).model->mass().mass * kGravity;
  EXPECT_TRUE(scene_.Touching(data_, kBottle, scene_.left_finger()));
  EXPECT_NEAR(scene_.WristWrench(data_).force.z(), -weight, 0.05 * weight);
  EXPECT_NEAR(other_.WristWrench(data_).force.norm(), 0, 0.05 * weight);
}

// Both hands are brought to the same place. The arms touch each other, and neither touches itself.
TEST_P(TwoRobots, TouchEachOther) {
  const domain::Problem others = WorkedBy(problem_, Other());
  const Pose down = geometry::PoseFromColumns({-1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 0.4});
  const auto posture = [&](const domain::Workcell& workcell) {
    for (const auto& s : workcell.arm().Inverse(workcell.FlangeFor(down), workcell.home())) {
      if (workcell.arm().InRange(s.q)) return s.q;
    }
    return workcell.home();
  };
  scene_.SetArm(data_, posture(*workcell_));
  EXPECT_EQ(data_.get()->ncon, CountOf(kBottle));
  other_.SetArm(data_, posture(*others.workcell));
  int between = 0;
  for (const mujoco::Contact& contact : mujoco::Contacts(data_)) {
    const std::string a = data_.model().Name(contact.body_a);
    const std::string b = data_.model().Name(contact.body_b);
    EXPECT_NE(a.substr(0, a.find('/')), b.substr(0, b.find('/'))) << a << " " << b;
    const bool is_of_both = a.starts_with("left/") != b.starts_with("left/") &&
                            a.starts_with("right/") != b.starts_with("right/");
    if (is_of_both) ++between;
  }
  EXPECT_GT(between, 0);
}

TEST(SceneOfTwoRobots, HasTheColorsOfTheTrial) {
  const Eigen::Vector4d amber(0.8, 0.5, 0.1, 1);
  const domain::Problem problem = Bottle();
  const std::string plain = ToMjcf(problem, {});
  EXPECT_EQ(plain.find("0.8 0.5 0.1 1"), std::string::npos);
  EXPECT_NE(ToMjcf(problem, {.part_colors = {{kBottle, amber}}}).find("0.8 0.5 0.1 1"),
            std::string::npos);
}

}  // namespace
}  // namespace assay::scene::two_robots_test
