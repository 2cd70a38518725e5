#include "planner/kinematics/arm_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "planner/base/random.h"
#include "planner/kinematics/arm.h"
#include "tests/scratch_file.h"

namespace assay::kinematics::arm_model_test {
namespace {

const std::string kUr5e = ASSAY_SOURCE_DIR "/models/robots/ur5e/ur5e.urdf";

std::string Ur5eWith(const std::string& from, const std::string& to) {
  std::stringstream stream;
  stream << std::ifstream(kUr5e).rdbuf();
  std::string text = stream.str();
  EXPECT_NE(text.find(from), std::string::npos) << from;
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

std::filesystem::path Written(const std::string& text) {
  const std::filesystem::path path = ScratchFile("arm.urdf");
  std::ofstream(path) << text;
  return path;
}

JointVector RandomPosture(RandomStream& random) {
  JointVector q;
  for (double& angle : q) angle = random.Uniform(-M_PI, M_PI);
  return q;
}

// What a body weighs and how it resists turns, about the world's origin.
struct Heft {
  double mass = 0;
  Vector3 moment = Vector3::Zero();   // mass times the centre of mass
  Matrix3 inertia = Matrix3::Zero();  // about the origin

  void Add(const Pose& X_WorldLink, const Inertial& inertial) {
    const Pose X = X_WorldLink * inertial.X_LinkCenter;
    const Vector3 c = X.translation();
    mass += inertial.mass;
    moment += inertial.mass * c;
    inertia += X.linear() * inertial.inertia * X.linear().transpose() +
               inertial.mass * (c.squaredNorm() * Matrix3::Identity() - c * c.transpose());
  }
};

// Follows the file's own joints, link by link.
Heft HeftOfFile(const RobotModel& model, const JointVector& q) {
  Heft heft;
  std::vector<Pose> poses = {Pose::Identity()};
  int moved = 0;
  for (const Joint& joint : model.joints) {
    const double value = joint.type == JointType::kFixed ? 0 : q[moved++];
    poses.push_back(poses[static_cast<std::size_t>(joint.parent.index())] *
                    joint.X_ParentChild(value));
  }
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    if (model.links[i].inertial) heft.Add(poses[i], *model.links[i].inertial);
  }
  return heft;
}

Heft HeftOfArm(const Arm& arm, const JointVector& q) {
  Heft heft;
  const std::array<Pose, 7> poses = arm.LinkPoses(q);
  for (std::size_t i = 0; i < 7; ++i) {
    const auto& inertial = arm.model().links[i].inertial;
    if (inertial) heft.Add(poses[i], *inertial);
  }
  return heft;
}

// Tool and camera are fixed to the arm: the one behind the last joint, the other on the forearm.
constexpr const char* kWithExtras = R"(
  <link name="camera"><inertial><origin xyz="0.01 0 0.02" rpy="0.3 0.1 0"/><mass value="0.8"/>
    <inertia ixx="0.002" ixy="0" ixz="0" iyy="0.003" iyz="0" izz="0.004"/></inertial>
    <visual><geometry><mesh filename="camera.dae"/></geometry></visual>
    <collision><geometry><box size="0.05 0.04 0.03"/></geometry></collision></link>
  <joint name="camera" type="fixed"><parent link="forearm"/><child link="camera"/>
    <origin xyz="0.1 0.05 0.07" rpy="0.2 0.4 -0.9"/></joint>
</robot>)";

TEST(ArmModel, KeepsMassesAndInertiasOfFixedLinks) {
  const auto file = Written(Ur5eWith("</robot>", kWithExtras));
  const RobotModel model = ReadUrdf(file);
  const Arm arm = Arm::FromUrdf(file, {"base", "flange"});
  ASSERT_EQ(arm.model().links.size(), 7u);
  RandomStream random(1, "masses");
  for (int i = 0; i < 50; ++i) {
    const JointVector q = RandomPosture(random);
    const Heft of_file = HeftOfFile(model, q);
    const Heft of_arm = HeftOfArm(arm, q);
    EXPECT_NEAR(of_arm.mass, of_file.mass, 1e-12);
    EXPECT_LT((of_arm.moment - of_file.moment).norm(), 1e-12);
    EXPECT_LT((of_arm.inertia - of_file.inertia).norm(), 1e-12);
  }
}

TEST(ArmModel, KeepsTheShapesOfFixedLinksInPlace) {
  const auto file = Written(Ur5eWith("</robot>", kWithExtras));
  const Arm arm = Arm::FromUrdf(file, {"base", "flange"});
  const Arm without = Arm::FromUrdf(kUr5e);
  const auto& shapes = arm.model().links[3].collisions;
  ASSERT_EQ(shapes.size(), without.model().links[3].collisions.size() + 1);
  EXPECT_LT((shapes.back().X_LinkShape.translation() - Vector3(0.1, 0.05, 0.07)).norm(), 1e-12);
  EXPECT_EQ(arm.model().links[3].meshes.size(), 1u) << "a mesh that is not read is noted";
}

TEST(ArmModel, TheFlangeIsTheTipOfTheFile) {
  const SerialChain chain = SerialChain::FromModel(ReadUrdf(kUr5e));
  const Arm arm = Arm::FromUrdf(kUr5e);
  RandomStream random(2, "flange");
  for (int i = 0; i < 100; ++i) {
    const JointVector q = RandomPosture(random);
    const Pose X = chain.Forward(q);
    EXPECT_LT((arm.Forward(q).matrix() - X.matrix()).norm(), 1e-12);
    EXPECT_LT((arm.LinkPoses(q).back().matrix() - X.matrix()).norm(), 1e-12);
  }
}

// With a rounded right angle, the arm is that of the drawing, and its indicators tell all solutions
// apart.
TEST(ArmModel, RightAnglesOfAFileMayBeRounded) {
  const Arm exact = Arm::FromUrdf(kUr5e);
  const Arm rounded = Arm::FromUrdf(Written(Ur5eWith("-1.5707963267948966 0 0", "-1.5708 0 0")));
  EXPECT_TRUE(exact.IndicatorsTellAllApart());
  EXPECT_TRUE(rounded.IndicatorsTellAllApart());
  RandomStream random(3, "rounded");
  for (int i = 0; i < 100; ++i) {
    const JointVector q = RandomPosture(random);
    EXPECT_LT((exact.Forward(q).matrix() - rounded.Forward(q).matrix()).norm(), 1e-12);
  }
}

const std::string kIiwa7 = ASSAY_SOURCE_DIR "/models/robots/iiwa7/iiwa7.urdf";

// The other six joints move as in the chain of seven.
TEST(LockedJoints, KeepTheirValues) {
  const SerialChain chain = SerialChain::FromModel(ReadUrdf(kIiwa7));
  ASSERT_EQ(chain.size(), 7);
  RandomStream random(4, "locked");
  // Without joint 4, the elbow, the arm is singular. Without joint 7, the flange is off its last
  // axis.
  for (const int joint : {0, 1, 2, 4, 5}) {
    const double value = random.Uniform(-1.5, 1.5);
    const std::string& name = chain.joints()[static_cast<std::size_t>(joint)].name;
    const Arm arm = Arm::FromUrdf(kIiwa7, {.locked = {{name, value}}});
    for (int i = 0; i < 20; ++i) {
      ChainVector all(7);
      for (double& angle : all) angle = random.Uniform(-1.5, 1.5);
      all[joint] = value;
      JointVector q;
      for (int k = 0; k < 6; ++k) q[k] = all[k < joint ? k : k + 1];
      EXPECT_LT((arm.Forward(q).matrix() - chain.Forward(all).matrix()).norm(), 1e-9) << name;
    }
  }
}

TEST(LockedJoints, AreChosenSoThatSolutionsCanBeToldApart) {
  const RobotModel model = ReadUrdf(kIiwa7);
  const std::vector<LockedJoints> lockings = Lockings(model, "", "");
  EXPECT_TRUE(Arm::FromModel(model, {.locked = lockings.front()}).IndicatorsTellAllApart());
  bool told_apart = true;
  for (const LockedJoints& locked : lockings) {
    const bool is = Arm::FromModel(model, {.locked = locked}).IndicatorsTellAllApart();
    EXPECT_TRUE(told_apart || !is) << "the best come first";
    told_apart = is;
  }
  EXPECT_EQ(Lockings(ReadUrdf(kUr5e), "", ""), std::vector<LockedJoints>{{}});
}

// Erases the elements of this name in a link of a URDF file.
void EraseElements(const std::string& link, const std::string& element, std::string& text) {
  const std::string end = "</" + element + ">";
  while (true) {
    const std::size_t begin = text.find("<link name=\"" + link + "\"");
    const std::size_t at = text.find("<" + element, begin);
    if (at > text.find("</link>", begin)) return;
    text.erase(at, text.find(end, at) + end.size() - at);
  }
}

TEST(ArmModel, ALinkWithoutAMassGetsThatOfItsShapes) {
  std::string text = Ur5eWith("</robot>", "</robot>");
  EraseElements("forearm", "inertial", text);
  const Arm arm = Arm::FromUrdf(Written(text));
  const Link& forearm = arm.model().link(arm.model().FindLink("forearm"));
  EXPECT_TRUE(forearm.inertial_is_derived);
  ASSERT_TRUE(forearm.inertial);
  EXPECT_GT(forearm.inertial->mass, 1);
  EXPECT_LT(forearm.inertial->mass, 10);
  EXPECT_FALSE(arm.model().links[1].inertial_is_derived);
  EraseElements("forearm", "collision", text);
  try {
    Arm::FromUrdf(Written(text));
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("neither a mass nor a collision shape"));
  }
}

TEST(LockedJoints, AreNamedInErrors) {
  const auto message = [](const LockedJoints& locked) -> std::string {
    try {
      Arm::FromUrdf(kIiwa7, {.locked = locked});
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  EXPECT_THAT(message({}), testing::HasSubstr("seven revolute joints"));
  EXPECT_THAT(message({{"a9", 0}}), testing::HasSubstr("no revolute joint 'a9'"));
  EXPECT_THAT(message({{"a4", 3}}), testing::HasSubstr("outside its limits"));
  EXPECT_THAT(message({{"a3", 0}}), "");
}

}  // namespace
}  // namespace assay::kinematics::arm_model_test
