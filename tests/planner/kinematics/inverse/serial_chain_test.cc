#include "planner/kinematics/inverse/serial_chain.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "bench/workloads/published_arms.h"
#include "planner/base/input_files/input_error.h"
#include "planner/kinematics/arm.h"
#include "tests/scratch_file.h"

namespace assay::kinematics::serial_chain_test {
namespace {

std::string JointText(const std::string& name, const std::string& type, const std::string& parent,
                      const std::string& child, const std::string& more = "") {
  return fmt::format(
      R"(<joint name="{}" type="{}"><parent link="{}"/><child link="{}"/>
<origin xyz="0 0 0.1" rpy="0 0.3 0.2"/><axis xyz="0 1 1"/>
<limit lower="-1" upper="2" velocity="3" effort="0"/>{}</joint>
)",
      name, type, parent, child, more);
}

// An arm with a mesh, a fixed joint at its base, and a hand with two fingers.
std::string ArmText(const std::string& more = "") {
  std::string text = "<robot name=\"arm\"><link name=\"world\"/>\n";
  for (int i = 0; i <= 6; ++i) {
    text += fmt::format(
        "<link name=\"link{}\"><visual><geometry><mesh "
        "filename=\"package://arm/{}.dae\"/></geometry></visual></link>\n",
        i, i);
  }
  text += JointText("mount", "fixed", "world", "link0");
  for (int i = 1; i <= 6; ++i) {
    text += JointText(fmt::format("j{}", i), i == 6 ? "continuous" : "revolute",
                      fmt::format("link{}", i - 1), fmt::format("link{}", i));
  }
  text += "<link name=\"hand\"/><link name=\"left\"/><link name=\"right\"/>\n";
  text += JointText("wrist", "fixed", "link6", "hand");
  text += JointText("finger1", "revolute", "hand", "left");
  text += JointText("finger2", "revolute", "hand", "right", "<mimic joint=\"finger1\"/>");
  return text + more + "</robot>";
}

RobotModel Read(const std::string& text) {
  const std::filesystem::path path = ScratchFile("chain.urdf");
  std::ofstream(path) << text;
  return ReadUrdf(path, UrdfContents::kAxes);
}

std::string Refusal(const std::string& text, const std::string& base = "",
                    const std::string& tip = "") {
  try {
    SerialChain::FromModel(Read(text), base, tip);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SerialChain, EndsWhereTheGripperBegins) {
  const SerialChain chain = SerialChain::FromModel(Read(ArmText()));
  EXPECT_EQ(chain.base(), "world");
  EXPECT_EQ(chain.tip(), "hand");
  ASSERT_EQ(chain.size(), 6);
  EXPECT_EQ(chain.joints()[2].name, "j3");
  EXPECT_EQ(chain.joints()[2].limits.upper, 2);
  EXPECT_NEAR(chain.axis(3).direction.norm(), 1, 1e-15);
}

TEST(SerialChain, HasThePosesOfTheLinksOneByOne) {
  const RobotModel model = Read(ArmText());
  const SerialChain chain = SerialChain::FromModel(model, "link0", "hand");
  RandomStream random(1, "chain");
  const ChainVector q = workloads::RandomTurns(random, 6);
  Pose X = Pose::Identity();
  for (int i = 0; i < 6; ++i) {
    X = X * model.joint(model.FindJoint(chain.joints()[static_cast<std::size_t>(i)].name))
                .X_ParentChild(q[i]);
  }
  X = X * model.joint(model.FindJoint("wrist")).X_ParentChild(0);
  EXPECT_LT((chain.Forward(q).matrix() - X.matrix()).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(SerialChain, HasTheJacobianOfItsForwardKinematics) {
  const SerialChain chain = SerialChain::FromModel(Read(ArmText()));
  RandomStream random(2, "chain");
  const ChainVector q = workloads::RandomTurns(random, 6);
  Pose X;
  const ChainJacobian J = chain.Jacobian(q, &X);
  EXPECT_LT((X.matrix() - chain.Forward(q).matrix()).cwiseAbs().maxCoeff(), 1e-14);
  for (int i = 0; i < 6; ++i) {
    ChainVector moved = q;
    moved[i] += 1e-6;
    const Pose Y = chain.Forward(moved);
    const Vector3 velocity = (Y.translation() - X.translation()) / 1e-6;
    const Eigen::AngleAxisd turn(Y.linear() * X.linear().transpose());
    EXPECT_LT((J.col(i).head<3>() - velocity).norm(), 1e-5);
    EXPECT_LT((J.col(i).tail<3>() - turn.angle() * turn.axis() / 1e-6).norm(), 1e-5);
  }
}

TEST(SerialChain, MovesTheSameWithALockedJoint) {
  const SerialChain chain = workloads::PublishedRedundantArms()[0].chain;
  RandomStream random(3, "chain");
  const ChainVector q = workloads::RandomTurns(random, 7);
  for (int joint = 0; joint < 7; ++joint) {
    ChainVector rest(6);
    rest << q.head(joint), q.tail(6 - joint);
    const Pose X = chain.Locked(joint, q[joint]).Forward(rest);
    EXPECT_LT((X.matrix() - chain.Forward(q).matrix()).cwiseAbs().maxCoeff(), 1e-14);
  }
}

TEST(SerialChain, RefusesWhatIsNoChainOfSixOrSevenRevoluteJoints) {
  using testing::AllOf;
  using testing::HasSubstr;
  EXPECT_THAT(Refusal(ArmText(), "link2"),
              AllOf(HasSubstr("has 4 revolute joints"), HasSubstr("six or seven")));
  EXPECT_THAT(Refusal(ArmText(), "", "flange"), HasSubstr("has no link 'flange' for the tip"));
  EXPECT_THAT(Refusal(ArmText(), "link3", "link1"),
              HasSubstr("'link1' is not behind link 'link3'"));
  EXPECT_THAT(Refusal(ArmText(), "", "right"), HasSubstr("'finger2' is between base and tip and"));
  const std::string rail = "<link name=\"rail\"/>" + JointText("rail", "prismatic", "hand", "rail");
  EXPECT_THAT(Refusal(ArmText(rail), "", "rail"), AllOf(HasSubstr("is prismatic"), HasSubstr(":")));
  std::string two_tips =
      ArmText("<link name=\"tool0\"/>" + JointText("t", "fixed", "link6", "tool0"));
  for (const char* finger : {"finger1\" type=\"revolute", "finger2\" type=\"revolute"}) {
    const std::size_t at = two_tips.find(finger);
    two_tips.replace(at, std::string(finger).size(), std::string(finger, 7) + "\" type=\"fixed");
  }
  two_tips.erase(two_tips.find("<mimic"), std::string("<mimic joint=\"finger1\"/>").size());
  EXPECT_THAT(Refusal(two_tips), AllOf(HasSubstr("tool0, left, right"), HasSubstr("--tip")));
}

TEST(UrdfContents, OnlyAxesNeedNoMeshes) {
  const RobotModel model = Read(ArmText());
  EXPECT_EQ(model.link(model.FindLink("link2")).meshes.front().file, "package://arm/2.dae");
  EXPECT_FALSE(model.link(model.FindLink("link2")).meshes.front().for_collision);
  EXPECT_FALSE(model.joint(model.FindJoint("finger2")).mimics.empty());
  EXPECT_THROW(ReadUrdf(ScratchFile("chain.urdf")), InputError);
}

}  // namespace
}  // namespace assay::kinematics::serial_chain_test
