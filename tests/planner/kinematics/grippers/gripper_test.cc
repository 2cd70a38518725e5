#include "planner/kinematics/grippers/gripper.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <sstream>

#include "planner/base/input_files/input_error.h"
#include "planner/geometry/box.h"
#include "tests/scratch_file.h"

namespace assay::kinematics::gripper_test {
namespace {

const std::filesystem::path kJaw =
    std::filesystem::path(ASSAY_SOURCE_DIR) / "models/grippers/parallel-jaw/gripper.urdf";

const Gripper& Jaw() {
  static const Gripper gripper = Gripper::FromUrdf(kJaw);
  return gripper;
}

// The extent of an unrotated box along one axis, metres.
struct Extent {
  double low;
  double high;
};
Extent ExtentOf(const Box& box, int axis) {
  EXPECT_TRUE(box.X_FrameBox.linear().isIdentity(1e-12));
  const double center = box.X_FrameBox.translation()[axis];
  return {center - box.half_extents[axis], center + box.half_extents[axis]};
}

TEST(Gripper, FourInchOpening) {
  EXPECT_NEAR(Jaw().max_opening(), 4 * 0.0254, 1e-12);
  EXPECT_EQ(Jaw().max_force(), 150);
  EXPECT_NEAR(
      (Jaw().X_FlangeTool().matrix() - Pose(Eigen::Translation3d(0, 0, 0.200)).matrix()).norm(), 0,
      1e-12);
  EXPECT_NEAR((Jaw().pad_half_extents() - geometry::Vector2(0.008, 0.008)).norm(), 0, 1e-12);
}

TEST(Gripper, PadsFaceEachOtherAtTheOpening) {
  for (const double opening : {0.0, 0.03, 0.1016}) {
    double left = std::numeric_limits<double>::infinity();
    double right = -left;
    for (const Box& box : Jaw().FingerBoxes(opening)) {
      const Extent y = ExtentOf(box, 1);
      if (box.X_FrameBox.translation().y() > 0) left = std::min(left, y.low);
      if (box.X_FrameBox.translation().y() < 0) right = std::max(right, y.high);
    }
    EXPECT_NEAR(left, opening / 2, 1e-12);
    EXPECT_NEAR(right, -opening / 2, 1e-12);
  }
}

TEST(Gripper, NothingReachesBeyondThePads) {
  const double pad_end = Jaw().pad_half_extents().y();
  for (const Box& box : Jaw().FingerBoxes(0.05)) {
    EXPECT_LE(ExtentOf(box, 2).high, pad_end + 1e-12);
  }
}

TEST(Gripper, FingersStayWithinTheHandsWidthAndClearOfThePart) {
  ASSERT_EQ(Jaw().HandBoxes().size(), 1u);
  const Box& hand = Jaw().HandBoxes()[0];
  EXPECT_LE(ExtentOf(hand, 2).high, -0.10);
  for (const Box& box : Jaw().FingerBoxes(Jaw().max_opening())) {
    EXPECT_GE(ExtentOf(box, 1).low, ExtentOf(hand, 1).low);
    EXPECT_LE(ExtentOf(box, 1).high, ExtentOf(hand, 1).high);
    // A finger touches the hand without overlapping it.
    EXPECT_GE(ExtentOf(box, 2).low, ExtentOf(hand, 2).high - 1e-12);
  }
}

struct WrongGripper {
  const char* name;
  const char* from;
  const char* to;
  const char* message;
};

class WrongGripperFile : public testing::TestWithParam<WrongGripper> {};

TEST_P(WrongGripperFile, IsRefused) {
  std::stringstream stream;
  stream << std::ifstream(kJaw).rdbuf();
  std::string text = stream.str();
  const std::string from = GetParam().from;
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + std::string(GetParam().to).size())) {
    text.replace(at, from.size(), GetParam().to);
  }
  const std::filesystem::path path = ScratchFile("gripper.urdf");
  std::ofstream(path) << text;
  try {
    Gripper::FromUrdf(path);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(path.string()));
    EXPECT_THAT(error.what(), testing::HasSubstr(GetParam().message));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Cases, WrongGripperFile,
    testing::Values(WrongGripper{"no_tool", "\"tool\"", "\"tip\"", "no link 'tool'"},
                    WrongGripper{"no_pad", "<collision name=\"pad\">", "<collision name=\"tip\">",
                                 "no collision box named 'pad'"},
                    WrongGripper{"turning_finger", "type=\"prismatic\"", "type=\"revolute\"",
                                 "not a prismatic"},
                    WrongGripper{"same_side", "<axis xyz=\"0 -1 0\"/>", "<axis xyz=\"0 1 0\"/>",
                                 "moves along (0, 1, 0)"},
                    WrongGripper{"round_hand", "<box size=\"0.07 0.15 0.085\"/>",
                                 "<cylinder radius=\"0.07\" length=\"0.085\"/>", "not a box"},
                    WrongGripper{"tool_off_pads",
                                 "<child link=\"tool\"/>\n    <origin xyz=\"0 0 0.200\"/>",
                                 "<child link=\"tool\"/>\n    <origin xyz=\"0 0 0.210\"/>",
                                 "inner face at (0, 0, -0.0"}),
    [](const testing::TestParamInfo<WrongGripper>& wrong) {
      return std::string(wrong.param.name);
    });

}  // namespace
}  // namespace assay::kinematics::gripper_test
