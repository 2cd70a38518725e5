#include "planner/kinematics/grippers/gripper_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

#include "planner/base/input_files/input_error.h"
#include "planner/geometry/box.h"
#include "planner/geometry/pose.h"
#include "planner/kinematics/grippers/gripper.h"
#include "tests/scratch_file.h"

namespace assay::kinematics::gripper_model_test {
namespace {

const std::string kWsg50 = ASSAY_SOURCE_DIR "/models/grippers/wsg50/wsg50.urdf";

GripperInFile Wsg50(const std::filesystem::path& file = kWsg50) {
  const PadFace face{.center = {0, 0, 0.1}, .size = {0.02, 0.02}};
  return {.file = file, .pads = {{"finger_a", face}, {"finger_b", face}}};
}

std::filesystem::path Wsg50With(const std::string& from, const std::string& to) {
  std::stringstream stream;
  stream << std::ifstream(kWsg50).rdbuf();
  std::string text = stream.str();
  EXPECT_NE(text.find(from), std::string::npos) << from;
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  const std::filesystem::path path = ScratchFile("gripper.urdf");
  std::ofstream(path) << text;
  return path;
}

// The least and greatest coordinates of all corners of boxes.
struct Bounds {
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 high = -low;
};
Bounds BoundsOf(const std::vector<Box>& boxes) {
  Bounds bounds;
  for (const Box& box : boxes) {
    for (const Vector3& corner : box.Corners()) {
      bounds.low = bounds.low.cwiseMin(corner);
      bounds.high = bounds.high.cwiseMax(corner);
    }
  }
  return bounds;
}

// The numbers are those of the gripper's README.
TEST(ParallelGripperModel, ReadsAGripperOfAnotherForm) {
  const Gripper gripper = Gripper::FromUrdf(Wsg50());
  EXPECT_NEAR(gripper.max_opening(), 0.110, 1e-12);
  EXPECT_EQ(gripper.max_force(), 80);
  EXPECT_LT((gripper.pad_half_extents() - geometry::Vector2(0.01, 0.01)).norm(), 1e-12);
  const Pose& X_FlangeTool = gripper.X_FlangeTool();
  EXPECT_LT((X_FlangeTool.translation() - Vector3(0, 0, 0.1725)).norm(), 1e-12);
  EXPECT_LT((X_FlangeTool.linear().col(2) - Vector3::UnitZ()).norm(), 1e-12);
  EXPECT_LT((X_FlangeTool.linear().col(1) + Vector3::UnitX()).norm(), 1e-12)
      << "finger_a, which opens along -x, is the left one";
  const Bounds hand = BoundsOf(gripper.HandBoxes());
  EXPECT_LT((hand.low - Vector3(-0.025, -0.073, -0.1725)).norm(), 1e-12);
  EXPECT_LT((hand.high - Vector3(0.025, 0.073, -0.1)).norm(), 1e-12);
}

TEST(ParallelGripperModel, KeepsMassesOfTheFile) {
  const RobotModel of_file = ReadUrdf(kWsg50);
  const RobotModel model = Gripper::FromUrdf(Wsg50()).model();
  const auto mass = [](const RobotModel& robot) {
    double sum = 0;
    for (const Link& link : robot.links) sum += link.inertial ? link.inertial->mass : 0;
    return sum;
  };
  EXPECT_NEAR(mass(model), mass(of_file), 1e-12);
}

TEST(ParallelGripperModel, OnlyPadsComeToTheMiddle) {
  const Gripper gripper = Gripper::FromUrdf(Wsg50());
  for (const double opening : {0.0, 0.04, 0.11}) {
    int innermost = 0;
    for (const Box& box : gripper.FingerBoxes(opening)) {
      const Bounds bounds = BoundsOf({box});
      const double inner = std::max(bounds.low.y(), -bounds.high.y()) - opening / 2;
      if (inner > 1e-12) {
        EXPECT_GE(inner, 0.0005 - 1e-12);
        continue;
      }
      ++innermost;
      EXPECT_NEAR(inner, 0, 1e-12);
      EXPECT_NEAR(bounds.high.x() - bounds.low.x(), 0.02, 1e-12);
      EXPECT_NEAR(bounds.high.z() - bounds.low.z(), 0.02, 1e-12);
    }
    EXPECT_EQ(innermost, 2);
  }
}

// A gripper that is mounted on a turned and shifted plate has the same shapes in its tool frame.
TEST(ParallelGripperModel, FollowsTheFlange) {
  const auto file = Wsg50With("</robot>", R"(<link name="plate"/>
    <joint name="plate" type="fixed"><parent link="base"/><child link="plate"/>
    <origin xyz="0.01 0.02 -0.03" rpy="0 0 0.5"/></joint></robot>)");
  GripperInFile on_plate = Wsg50(file);
  on_plate.flange = "plate";
  const Gripper plain = Gripper::FromUrdf(Wsg50());
  const Gripper turned = Gripper::FromUrdf(on_plate);
  const Pose X_BasePlate = geometry::Translation(0.01, 0.02, -0.03) * geometry::RotationZ(0.5);
  const Pose expected = X_BasePlate.inverse() * plain.X_FlangeTool();
  EXPECT_LT((turned.X_FlangeTool().matrix() - expected.matrix()).norm(), 1e-9);
  const Bounds a = BoundsOf(plain.HandBoxes());
  const Bounds b = BoundsOf(turned.HandBoxes());
  EXPECT_LT((a.low - b.low).norm() + (a.high - b.high).norm(), 1e-9);
}

TEST(ParallelGripperModel, PutsBoxesAroundOtherShapes) {
  const auto file = Wsg50With("<box size=\"0.146 0.05 0.0725\"/>",
                              "<cylinder radius=\"0.073\" length=\"0.0725\"/>");
  const Bounds hand = BoundsOf(Gripper::FromUrdf(Wsg50(file)).HandBoxes());
  EXPECT_LT((hand.low - Vector3(-0.073, -0.073, -0.1725)).norm(), 1e-12);
  EXPECT_LT((hand.high - Vector3(0.073, 0.073, -0.1)).norm(), 1e-12);
}

std::string Refusal(const GripperInFile& gripper) {
  try {
    Gripper::FromUrdf(gripper);
    return "accepted";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(ParallelGripperModel, SaysWhatIsWrong) {
  using testing::HasSubstr;
  EXPECT_THAT(Refusal(Wsg50(Wsg50With("type=\"prismatic\"", "type=\"revolute\""))),
              HasSubstr("mimics"));
  EXPECT_THAT(Refusal(Wsg50(Wsg50With("multiplier=\"-1\"", "multiplier=\"-2\""))),
              HasSubstr("multiplier 1 or -1"));
  EXPECT_THAT(
      Refusal(Wsg50(Wsg50With("lower=\"0\" upper=\"0.055\"", "lower=\"0.001\" upper=\"0.055\""))),
      HasSubstr("when the gripper is closed"));
  GripperInFile wrong = Wsg50();
  wrong.pads["finger_b"].size = {0.02, 0.03};
  EXPECT_THAT(Refusal(wrong), HasSubstr("differ in size"));
  wrong = Wsg50();
  wrong.pads.erase("finger_b");
  EXPECT_THAT(Refusal(wrong), HasSubstr("'finger_b' has no pad"));
  wrong = Wsg50();
  wrong.pads["thumb"] = {};
  EXPECT_THAT(Refusal(wrong), HasSubstr("no link 'thumb'"));
  wrong.pads.erase("thumb");
  wrong.pads["base"] = {};
  EXPECT_THAT(Refusal(wrong), HasSubstr("no link 'base' that moves"));
  wrong = Wsg50();
  wrong.flange = "finger_a";
  EXPECT_THAT(Refusal(wrong), HasSubstr("that does not move"));
  wrong = Wsg50();
  for (auto& [name, pad] : wrong.pads) pad.center.x() = name == "finger_a" ? -0.004 : 0.004;
  EXPECT_THAT(Refusal(wrong), HasSubstr("when the gripper is closed"));
}

// A file may say what no gripper is.
TEST(ParallelGripperModel, RefusesWhatIsNoGripper) {
  using testing::HasSubstr;
  EXPECT_THAT(Refusal(Wsg50(Wsg50With("multiplier=\"-1\"", "multiplier=\"1\""))),
              HasSubstr("opposite directions"));
  EXPECT_THAT(Refusal(Wsg50(Wsg50With("mimic joint=\"finger_a\"", "mimic joint=\"none\""))),
              HasSubstr("mimics 'none'"));
  EXPECT_THAT(Refusal(Wsg50(Wsg50With("<mass value=\"0.2\"/>", "<mass value=\"0\"/>"))),
              HasSubstr("mass"));
  EXPECT_THAT(Refusal(Wsg50(Wsg50With("0.055", "0.0005"))), HasSubstr("opens by less than 1 mm"));
  const auto with_pads = [](const Vector3& center, const geometry::Vector2& size) {
    GripperInFile gripper = Wsg50();
    for (auto& [name, pad] : gripper.pads) pad = {center, size};
    return gripper;
  };
  EXPECT_THAT(Refusal(with_pads({0, 0.1, 0.1}, {0.02, 0.02})), HasSubstr("no shape of the finger"));
  EXPECT_THAT(Refusal(with_pads({0, 0, 0.6}, {0.02, 0.02})), HasSubstr("no shape of the finger"));
  EXPECT_THAT(Refusal(with_pads({0, 0, 0.1}, {0.2, 0.02})), HasSubstr("reaches beyond its finger"));
  EXPECT_THAT(Refusal(with_pads({0, 0, 0.1}, {1e-9, 0.02})), HasSubstr("at least 1 by 1 mm"));
}

// Files round right angles, and a layer of rubber may be thinner than what is cut off.
TEST(ParallelGripperModel, TakesRoundedAnglesAndThinLayers) {
  const auto on_plate = Wsg50With("</robot>", R"(<link name="plate"/>
    <joint name="plate" type="fixed"><parent link="base"/><child link="plate"/>
    <origin rpy="1.5708 0 0"/></joint></robot>)");
  GripperInFile gripper = Wsg50(on_plate);
  gripper.flange = "plate";
  EXPECT_EQ(Refusal(gripper), "accepted");
  EXPECT_EQ(Refusal(Wsg50(Wsg50With("<origin xyz=\"0.002 0 0.1\" rpy=\"0 0 0\"/>\n      "
                                    "<geometry><box size=\"0.004 0.02 0.02\"/>",
                                    "<origin xyz=\"0.0002 0 0.1\" rpy=\"0 0 0\"/>\n      "
                                    "<geometry><box size=\"0.0004 0.02 0.02\"/>"))),
            "accepted");
}

}  // namespace
}  // namespace assay::kinematics::gripper_model_test
