#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/cli/program.h"

namespace assay::cli::tune_test {
namespace {

using ::testing::HasSubstr;

std::string RobotFile(const std::string& name, const std::string& file) {
  return fmt::format("{}/models/robots/{}/{}", ASSAY_SOURCE_DIR, name, file);
}

// The gains of the Puma 762 come from published inertias of motors.
TEST(TuneTest, DerivesTheGainsOfTheModels) {
  for (const std::string name : {"ur5e", "irb120", "kr6-r900", "puma560", "iiwa7"}) {
    const Folder folder;
    const Ended ended = Assay({"tune", RobotFile(name, name + ".urdf"), "-o", folder / "servos"});
    EXPECT_EQ(ended.code, 0) << name << ended.err;
    EXPECT_EQ(TextOf(folder / "servos"), TextOf(RobotFile(name, name + ".servos.yaml"))) << name;
    EXPECT_THAT(ended.out, HasSubstr("kg m^2"));
  }
}

TEST(TuneTest, NamesAWeakMotor) {
  const Folder folder;
  std::string text = TextOf(RobotFile("ur5e", "ur5e.urdf"));
  const std::string effort = "effort=\"150\"";
  text.replace(text.find(effort, text.find("shoulder_lift")), effort.size(), "effort=\"9\"");
  const Ended ended = Assay({"tune", folder.Write("weak.urdf", text)});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("The motor of shoulder_lift cannot carry the arm"));
  EXPECT_THAT(ended.out, HasSubstr("format: assay-servos/1"));
}

TEST(TuneTest, RefusesWhatIsNoArm) {
  const Ended ended =
      Assay({"tune", std::string(ASSAY_SOURCE_DIR) + "/models/grippers/parallel-jaw/gripper.urdf"});
  EXPECT_EQ(ended.code, 3);
}

}  // namespace
}  // namespace assay::cli::tune_test
