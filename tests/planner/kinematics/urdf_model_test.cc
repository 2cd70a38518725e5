#include "planner/kinematics/urdf_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "planner/base/input_files/input_error.h"
#include "tests/scratch_file.h"

namespace assay::kinematics::urdf_model_test {
namespace {

const std::filesystem::path kModels = std::filesystem::path(ASSAY_SOURCE_DIR) / "models";

std::filesystem::path WriteUrdf(const std::string& text) {
  const std::filesystem::path path = ScratchFile("model.urdf");
  std::ofstream(path) << text;
  return path;
}

constexpr const char* kTwoLinks = R"(<robot name="two">
  <material name="blue"><color rgba="0.1 0.2 0.9 0.5"/></material>
  <link name="a">
    <inertial><origin xyz="0 0 1"/><mass value="2"/>
      <inertia ixx="3" ixy="0.1" ixz="0" iyy="4" iyz="0" izz="5"/></inertial>
    <visual name="v"><origin xyz="1 2 3" rpy="0 0 1.5707963267948966"/>
      <geometry><box size="1 2 3"/></geometry><material name="blue"/></visual>
    <visual><geometry><cylinder radius="0.1" length="0.2"/></geometry></visual>
    <collision name="c"><geometry><sphere radius="0.3"/></geometry></collision>
  </link>
  <link name="b"/>
  <joint name="j" type="prismatic"><parent link="a"/><child link="b"/>
    <origin xyz="0 0 2"/><axis xyz="0 2 0"/>
    <limit lower="-1" upper="2" velocity="3" effort="4"/></joint>
</robot>)";

TEST(UrdfModel, KeepsWhatTheFileTells) {
  const RobotModel model = ReadUrdf(WriteUrdf(kTwoLinks));
  EXPECT_EQ(model.name, "two");
  ASSERT_EQ(model.links.size(), 2u);
  const Link& a = model.link(model.FindLink("a"));
  ASSERT_TRUE(a.inertial);
  EXPECT_EQ(a.inertial->mass, 2);
  EXPECT_EQ(a.inertial->inertia(0, 1), 0.1);
  EXPECT_EQ(a.inertial->X_LinkCenter.translation(), Vector3(0, 0, 1));
  ASSERT_EQ(a.visuals.size(), 2u);
  EXPECT_EQ(a.visuals[0].name, "v");
  EXPECT_EQ(std::get<BoxShape>(a.visuals[0].shape).size, Vector3(1, 2, 3));
  EXPECT_NEAR((a.visuals[0].X_LinkShape * Vector3(1, 0, 0) - Vector3(1, 3, 3)).norm(), 0, 1e-12);
  EXPECT_NEAR(a.visuals[0].color.blue, 0.9, 1e-6);
  EXPECT_NEAR(a.visuals[0].color.alpha, 0.5, 1e-6);
  EXPECT_EQ(std::get<CylinderShape>(a.visuals[1].shape).length, 0.2);
  ASSERT_EQ(a.collisions.size(), 1u);
  EXPECT_EQ(std::get<SphereShape>(a.collisions[0].shape).radius, 0.3);
  const Joint& j = model.joint(model.FindJoint("j"));
  EXPECT_EQ(j.parent, model.FindLink("a"));
  EXPECT_EQ(j.child, model.FindLink("b"));
  EXPECT_EQ(model.link(j.child).parent_joint, model.FindJoint("j"));
  EXPECT_EQ(j.axis, Vector3::UnitY());
  EXPECT_EQ(j.limits.upper, 2);
  EXPECT_EQ(j.limits.effort, 4);
  EXPECT_EQ(j.X_ParentChild(0.5).translation(), Vector3(0, 0.5, 2));
  EXPECT_FALSE(model.link(j.child).inertial);
  EXPECT_TRUE(model.FindLink("c").IsNone());
}

TEST(UrdfModel, ParentsStandBeforeChildren) {
  for (const char* file : {"robots/puma762/puma762.urdf", "grippers/parallel-jaw/gripper.urdf"}) {
    const RobotModel model = ReadUrdf(kModels / file);
    ASSERT_EQ(model.links.size(), model.joints.size() + 1);
    for (std::size_t i = 0; i < model.joints.size(); ++i) {
      EXPECT_EQ(model.joints[i].child, LinkId(i + 1));
      EXPECT_LT(model.joints[i].parent, model.joints[i].child);
    }
  }
}

struct WrongFile {
  const char* name;
  const char* from;
  const char* to;
  const char* message;
  const char* place = "";  // line and column
};

class WrongUrdf : public testing::TestWithParam<WrongFile> {};

TEST_P(WrongUrdf, IsRefusedQuietly) {
  std::string text = kTwoLinks;
  const std::string from = GetParam().from;
  text.replace(text.find(from), from.size(), GetParam().to);
  const std::filesystem::path path = WriteUrdf(text);
  testing::internal::CaptureStderr();
  try {
    ReadUrdf(path);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::StartsWith(path.string() + ":" + GetParam().place));
    EXPECT_GT(error.place().line, 0);
    EXPECT_GT(error.place().column, 0);
    EXPECT_THAT(error.what(), testing::HasSubstr(GetParam().message));
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

INSTANTIATE_TEST_SUITE_P(
    Cases, WrongUrdf,
    testing::Values(
        WrongFile{"not_xml", "<robot name=\"two\">", "robot", "is not a URDF file"},
        WrongFile{"not_closed", "</robot>", "", "is not a URDF file"},
        WrongFile{"unknown_parent", "<parent link=\"a\"/>", "<parent link=\"z\"/>",
                  "is not a URDF file"},
        WrongFile{"not_a_number", "mass value=\"2\"", "mass value=\"two\"", "is not a URDF file"},
        WrongFile{"mesh", "<sphere radius=\"0.3\"/>", "<mesh filename=\"a.stl\"/>",
                  "there is no such file"},
        WrongFile{"no_extent", "<sphere radius=\"0.3\"/>", "<sphere radius=\"0\"/>",
                  "positive extents"},
        WrongFile{"negative_mass", "mass value=\"2\"", "mass value=\"-2\"", "positive mass"},
        WrongFile{"impossible_inertia", "izz=\"5\"", "izz=\"9\"", "at most the sum"},
        WrongFile{"floating", "type=\"prismatic\"", "type=\"floating\"", "fixed, revolute"},
        WrongFile{"empty_range", "upper=\"2\"", "upper=\"-1\"", "lower below upper"},
        WrongFile{"no_speed", "velocity=\"3\"", "velocity=\"0\"", "velocity"},
        WrongFile{"no_number_has_its_place", "mass value=\"2\"", "mass value=\"two\"", "two",
                  "4:36: "},
        WrongFile{"a_link_has_its_place", "mass value=\"2\"", "mass value=\"0\"",
                  "a mass of 0 kg; allowed: a positive mass, at most 100000 kg", "3:3: "},
        WrongFile{"a_joint_has_its_place", "effort=\"4\"", "effort=\"0\"", "effort 0 N;", "12:3: "},
        WrongFile{"far_joint", "origin xyz=\"0 0 2\"", "origin xyz=\"0 0 1e9\"", "at most 100 m"},
        WrongFile{"far_shape", "xyz=\"1 2 3\"", "xyz=\"1 -101 3\"", "at most 100 m"},
        WrongFile{"far_center", "xyz=\"0 0 1\"", "xyz=\"0 0 101\"", "at most 100 m"},
        WrongFile{"no_place", "origin xyz=\"0 0 2\"", "origin xyz=\"0 0 nan\"", ""},
        WrongFile{"vast_shape", "size=\"1 2 3\"", "size=\"1 2 1e300\"",
                  "of extent 1e+300 m; allowed: positive extents, 1e-06 m to 100 m"},
        WrongFile{"minute_shape", "radius=\"0.3\"", "radius=\"1e-300\"", "positive extents"},
        WrongFile{"vast_mass", "mass value=\"2\"", "mass value=\"1e300\"", "at most 100000 kg"},
        WrongFile{"vast_inertia", "iyy=\"4\"", "iyy=\"1e300\"", "an inertia that is too large"},
        WrongFile{"vast_range", "upper=\"2\"", "upper=\"101\"", "from -100 m to 100 m"},
        WrongFile{"vast_speed", "velocity=\"3\"", "velocity=\"1e9\"",
                  "at most 1000 m/s; effort positive, at most 1000000 N"},
        WrongFile{"not_utf8", "name=\"two\"", "name=\"\xff\"", "0xff", "1:14: "},
        WrongFile{"no_limits", "<limit lower=\"-1\" upper=\"2\" velocity=\"3\" effort=\"4\"/>", "",
                  "limits"}),
    [](const testing::TestParamInfo<WrongFile>& wrong) { return std::string(wrong.param.name); });

TEST(UrdfModel, MissingFileIsAnInputError) {
  EXPECT_THROW(ReadUrdf(kModels / "robots/none.urdf"), InputError);
  EXPECT_THROW(ReadUrdf(kModels), InputError);
}

}  // namespace
}  // namespace assay::kinematics::urdf_model_test
