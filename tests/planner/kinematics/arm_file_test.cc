#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "planner/base/input_files/input_error.h"
#include "planner/kinematics/arm.h"
#include "tests/planner/kinematics/puma.h"

namespace assay::kinematics::arm_file_test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180;

TEST(ArmFile, Puma762Lengths) {
  const ArmGeometry& g = *Puma().geometry();
  EXPECT_DOUBLE_EQ(g.a2, 0.650);
  EXPECT_DOUBLE_EQ(g.a3, 0);
  EXPECT_DOUBLE_EQ(g.d2, 0.190);
  EXPECT_DOUBLE_EQ(g.d4, 0.600);
  EXPECT_DOUBLE_EQ(g.d6, 0.125);
}

TEST(ArmFile, Puma762LimitsAndSpeeds) {
  const double lower[6] = {-160, -200, -45, -266, -100, -266};
  const double upper[6] = {160, 20, 225, 266, 100, 266};
  const double speed[6] = {90, 90, 90, 180, 180, 180};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(Puma().limits()[i].lower, lower[i] * kDegree, 1e-12);
    EXPECT_NEAR(Puma().limits()[i].upper, upper[i] * kDegree, 1e-12);
    EXPECT_NEAR(Puma().limits()[i].velocity, speed[i] * kDegree, 1e-12);
  }
}

struct WrongArm {
  const char* name;
  const char* from;
  const char* to;
  const char* message;
};

class WrongArmFile : public testing::TestWithParam<WrongArm> {};

TEST_P(WrongArmFile, IsRefusedByNameAndReason) {
  const WrongArm& wrong = GetParam();
  const std::filesystem::path path =
      WriteUrdf(std::string(wrong.name) + ".urdf", PumaWith(wrong.from, wrong.to));
  try {
    Arm::FromUrdf(path);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(path.string()));
    EXPECT_THAT(error.what(), testing::HasSubstr(wrong.message));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Cases, WrongArmFile,
    testing::Values(
        WrongArm{"fixed_joint", "<joint name=\"elbow\" type=\"revolute\">",
                 "<joint name=\"elbow\" type=\"fixed\">", "has 5 revolute joints"},
        WrongArm{"sliding_joint", "<joint name=\"elbow\" type=\"revolute\">",
                 "<joint name=\"elbow\" type=\"prismatic\">", "has 2 revolute joints"},
        WrongArm{"branch", "<parent link=\"wrist_bend\"/>", "<parent link=\"wrist_roll\"/>",
                 "has 4 revolute joints"},
        WrongArm{"finger", "</robot>",
                 "<link name=\"x\"/><joint name=\"j\" type=\"prismatic\"><parent link=\"flange\"/>"
                 "<child link=\"x\"/><limit lower=\"0\" upper=\"1\" effort=\"1\" velocity=\"1\"/>"
                 "</joint></robot>",
                 "joint 'j' moves, but is not between base and flange"},
        WrongArm{"flange_off_axis", "</robot>",
                 "<link name=\"x\"/><joint name=\"j\" type=\"fixed\"><parent link=\"flange\"/>"
                 "<child link=\"x\"/><origin xyz=\"0.01 0 0\"/></joint></robot>",
                 "the flange's origin is 0.01 m off axis 6"},
        WrongArm{"no_lengths", "<origin xyz=\"0.650 0.190 0\"/>", "<origin xyz=\"0 0 0\"/>",
                 "in fewer than six ways"}),
    [](const testing::TestParamInfo<WrongArm>& wrong) { return std::string(wrong.param.name); });

TEST(ArmFile, AnEndlessJointTurnsOnceEitherWay) {
  const Arm arm = Arm::FromUrdf(
      WriteUrdf("endless.urdf", PumaWith("<joint name=\"waist\" type=\"revolute\">",
                                         "<joint name=\"waist\" type=\"continuous\">")));
  EXPECT_EQ(arm.limits()[0].lower, -2 * kPi);
  EXPECT_EQ(arm.limits()[0].upper, 2 * kPi);
}

TEST(ArmFile, AnEffortOfZeroIsUnknown) {
  const Arm arm =
      Arm::FromUrdf(WriteUrdf("unknown.urdf", PumaWith("effort=\"2000\"", "effort=\"0\"")));
  EXPECT_EQ(arm.limits()[0].effort, 0);
}

TEST(ArmFile, MissingJointLeavesTwoRoots) {
  std::string text = PumaText();
  const std::size_t begin = text.find("<joint name=\"wrist_bend\"");
  const std::size_t end = text.find("</joint>", begin) + 8;
  const auto path = WriteUrdf("missing_joint.urdf", text.erase(begin, end - begin));
  EXPECT_THROW(Arm::FromUrdf(path), InputError);
}

}  // namespace
}  // namespace assay::kinematics::arm_file_test
