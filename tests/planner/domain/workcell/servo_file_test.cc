#include "planner/domain/workcell/servo_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "planner/base/input_files/input_error.h"
#include "tests/scratch_file.h"

namespace assay::domain::servo_file_test {
namespace {

using ::testing::HasSubstr;

const kinematics::Arm& Puma() {
  static const auto arm =
      kinematics::Arm::FromUrdf(ASSAY_SOURCE_DIR "/models/robots/puma762/puma762.urdf");
  return arm;
}

kinematics::ArmServos Read(const std::string& text, const kinematics::LockedJoints& locked = {}) {
  const std::filesystem::path file = ScratchFile("servos.yaml");
  std::ofstream(file) << text;
  return ReadServos(file, Puma(), locked, [] {
    kinematics::ArmServos derived;
    derived.fill({.armature = 1, .stiffness = 2, .damping = 3});
    return derived;
  });
}

std::string ErrorOf(const std::string& text) {
  try {
    Read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string Text() {
  kinematics::ArmServos servos;
  for (std::size_t i = 0; i < 6; ++i) {
    const double number = 1 + static_cast<double>(i);
    servos[i] = {.armature = 0.123456 * number, .stiffness = 812345 * number, .damping = 7000};
  }
  return ServosText("a \"test\"", Puma(), servos);
}

std::string With(const std::string& from, const std::string& to) {
  std::string text = Text();
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST(ServoFile, KeepsThreeDigits) {
  const kinematics::ArmServos servos = Read(Text());
  EXPECT_DOUBLE_EQ(servos[0].armature, 0.123);
  EXPECT_DOUBLE_EQ(servos[1].stiffness, 1620000);
  EXPECT_DOUBLE_EQ(servos[5].stiffness, 4870000);
  EXPECT_DOUBLE_EQ(servos[3].damping, 7000);
}

// The file was written for an arm in which the first joint was locked, and now a seventh one is.
TEST(ServoFile, ServesAnArmWithAnotherLockedJoint) {
  const std::string first = Puma().model().joints[0].name;
  const kinematics::ArmServos servos = Read(With(first, "seventh"), {{"seventh", 0.5}});
  EXPECT_DOUBLE_EQ(servos[0].stiffness, 2);
  EXPECT_DOUBLE_EQ(servos[1].stiffness, 1620000);
}

TEST(ServoFile, SaysWhatIsWrong) {
  const std::string first = Puma().model().joints[0].name;
  EXPECT_THAT(ErrorOf(With(first, "knee")), HasSubstr("knee"));
  EXPECT_THAT(ErrorOf(With("armature: 0.123", "armature: -0.123")), HasSubstr("-0.123 kg m^2"));
  EXPECT_THAT(ErrorOf(With("damping: 7000", "dumping: 7000")), HasSubstr("dumping"));
  EXPECT_THAT(ErrorOf(With("stiffness: 812000, ", "")), HasSubstr("stiffness"));
  EXPECT_THAT(ErrorOf("format: assay-servos/2\njoints: {}\n"), HasSubstr("assay-servos/1"));
}

}  // namespace
}  // namespace assay::domain::servo_file_test
