#include "planner/domain/workcell/workcell.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <set>
#include <sstream>
#include <tuple>

#include "planner/base/input_files/input_error.h"
#include "planner/domain/actions/actions.h"
#include "planner/domain/workcell/workcell_file.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/pose.h"
#include "tests/scratch_file.h"

namespace assay::domain::workcell_test {
namespace {

using testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180;

std::filesystem::path FileOf(const std::string& workcell) {
  return std::filesystem::path(ASSAY_SOURCE_DIR) / "models/workcells" / workcell / "workcell.yaml";
}

class AnyWorkcell : public testing::TestWithParam<const char*> {
 protected:
  const std::shared_ptr<const Workcell> workcell_ = WorkcellFile::Read(FileOf(GetParam()));
};
INSTANTIATE_TEST_SUITE_P(Workcell, AnyWorkcell, testing::Values("puma762-table", "narrow-table"));

TEST_P(AnyWorkcell, IsNamedByItsFolder) { EXPECT_EQ(workcell_->name(), GetParam()); }

TEST_P(AnyWorkcell, HomeIsStraightDownAtSafeHeight) {
  const geometry::Pose X_WorldTool = workcell_->X_WorldBase() *
                                     workcell_->arm().Forward(workcell_->home()) *
                                     workcell_->gripper().X_FlangeTool();
  EXPECT_NEAR(X_WorldTool.linear()(2, 2), -1, 1e-9);
  EXPECT_NEAR(X_WorldTool.translation().z(), workcell_->rules().safe_height, 1e-4);
  EXPECT_GT(geometry::Depth(workcell_->table().top, X_WorldTool.translation().head<2>()), 0.1);
  EXPECT_EQ(workcell_->arm().IndicatorsOf(workcell_->home()).elbow, kinematics::Elbow::kAbove);
}

TEST_P(AnyWorkcell, FlangeForUndoesTheGripperAndTheBase) {
  const geometry::Pose X_WorldTool =
      geometry::Translation(0.5, -0.1, 0.2) * geometry::RotationX(3) * geometry::RotationZ(1);
  const geometry::Pose back = workcell_->X_WorldBase() * workcell_->FlangeFor(X_WorldTool) *
                              workcell_->gripper().X_FlangeTool();
  EXPECT_TRUE(back.isApprox(X_WorldTool, 1e-12));
}

// In figures 11 and 12 of Spar, the hand gropes if nothing was grasped, and a person is called if
// something else was grasped.
TEST_P(AnyWorkcell, KnowsWhatToDoAboutUncertainty) {
  const UncertaintyOperations& operations = workcell_->uncertainty_operations();
  const SensorModel* camera = operations.FindSensor("overhead-camera");
  ASSERT_NE(camera, nullptr);
  for (const Interval& promise : {camera->x, camera->y, camera->z}) {
    EXPECT_GT(promise.high, 0);
    EXPECT_LE(promise.high, 0.0001);
    EXPECT_EQ(promise.low, -promise.high);
  }
  EXPECT_LE(camera->theta.high, 0.2 * kDegree);
  EXPECT_EQ(operations.FindSensor("overhead-camra"), nullptr);

  ASSERT_EQ(operations.verifications.size(), 3u);
  const VerificationTemplate& opening = operations.verifications[0];
  EXPECT_EQ(opening.name, "gripper-opening");
  EXPECT_EQ(opening.after, &kPickup);
  EXPECT_EQ(opening.quantity, MeasuredQuantity::kGripperOpening);
  EXPECT_EQ(opening.tolerance, 0.001);
  const auto recovery = [&](const std::string& error) {
    return *std::ranges::find(operations.recoveries, error, &RecoveryTemplate::error);
  };
  EXPECT_EQ(recovery(opening.below).strategy, RecoveryStrategy::kGropingSearch);
  EXPECT_EQ(recovery(opening.below).radius, 0.010);
  EXPECT_EQ(recovery(opening.below).pitch, 0.003);
  EXPECT_EQ(recovery(opening.above).strategy, RecoveryStrategy::kCallOperator);
}

TEST_P(AnyWorkcell, PlacementsAreOnTheTableAndDiffer) {
  std::set<std::tuple<double, double, double>> seen;
  for (const Placement& p : workcell_->placements()) {
    EXPECT_GE(geometry::Depth(workcell_->table().top, {p.x, p.y}), 0);
    EXPECT_TRUE(seen.insert({p.x, p.y, p.yaw}).second);
  }
}

TEST(Workcell, ReadsTheRules) {
  const auto workcell = WorkcellFile::Read(FileOf("puma762-table"));
  EXPECT_NEAR(workcell->rules().tool_lean, 60 * kDegree, 1e-12);
  EXPECT_NEAR(workcell->rules().approach_step, 15 * kDegree, 1e-12);
  EXPECT_EQ(workcell->rules().friction, 0.25);
  EXPECT_EQ(workcell->rules().grip_force, 100);
  EXPECT_EQ(workcell->rules().part_gap, 0.015);
  EXPECT_EQ(workcell->rules().pad_margin, 0.001);
  EXPECT_EQ(workcell->rules().guarded_travel, 0.008);
  EXPECT_EQ(workcell->rules().lateral_compliance, 0);
  EXPECT_NEAR(workcell->joint_acceleration()[1], 150 * kDegree, 1e-12);
}

// There are 5 by 7 places with 12 yaws. They are ordered by the distance from (0.60, 0.00), then by
// x, y and yaw.
TEST(Workcell, PlacementsComeNearestFirst) {
  const auto workcell = WorkcellFile::Read(FileOf("puma762-table"));
  const std::vector<Placement>& placements = workcell->placements();
  ASSERT_EQ(placements.size(), 5u * 7u * 12u);
  const auto distance = [](const Placement& p) { return std::hypot(p.x - 0.60, p.y); };
  for (std::size_t i = 1; i < placements.size(); ++i) {
    const Placement& before = placements[i - 1];
    const Placement& p = placements[i];
    EXPECT_GE(distance(p), distance(before) - 1e-9) << i;
    if (p.x == before.x && p.y == before.y) {
      EXPECT_NEAR(p.yaw - before.yaw, 30 * kDegree, 1e-12);
    }
  }
  EXPECT_EQ(placements[0].yaw, 0);
}

TEST(Workcell, PlacementTurnsBeforeItMoves) {
  const Placement placement = {.x = 1, .y = 2, .yaw = std::numbers::pi / 2};
  EXPECT_TRUE((placement.X_WorldTable() * geometry::Vector3(1, 0, 3))
                  .isApprox(geometry::Vector3(1, 3, 3), 1e-12));
}

TEST(Workcell, WithRulesChangesNothingElse) {
  const auto workcell = WorkcellFile::Read(FileOf("puma762-table"));
  WorkcellRules rules = workcell->rules();
  rules.tool_lean = 0.1;
  const auto changed = workcell->WithRules(rules);
  EXPECT_EQ(changed->rules().tool_lean, 0.1);
  EXPECT_NEAR(workcell->rules().tool_lean, 60 * kDegree, 1e-12);
  EXPECT_EQ(changed->placements().size(), workcell->placements().size());
  EXPECT_EQ(changed->uncertainty_operations().sensors.size(),
            workcell->uncertainty_operations().sensors.size());
  EXPECT_EQ(&changed->arm(), &workcell->arm());
}

TEST(Workcell, OneRobotHasNoName) {
  const auto workcell = WorkcellFile::Read(FileOf("puma762-table"));
  ASSERT_EQ(workcell->robots().size(), 1u);
  EXPECT_EQ(workcell->robot().Prefix(), "");
}

TEST(Workcell, IsSeenByTheRobotThatActs) {
  const auto left = WorkcellFile::Read(FileOf("two-pumas"));
  ASSERT_EQ(left->robots().size(), 2u);
  EXPECT_EQ(left->robot().name, "left");
  const auto right = left->WorkedBy(RobotId(1));
  EXPECT_EQ(right->robot().name, "right");
  EXPECT_EQ(right->robot().Prefix(), "right/");
  EXPECT_EQ(&right->arm(), right->robots()[1].arm.get());
  // The robots stand opposite each other, symmetric about the z axis of the world.
  EXPECT_TRUE(right->X_WorldBase().isApprox(
      geometry::RotationZ(std::numbers::pi) * left->X_WorldBase(), 1e-12));
  EXPECT_TRUE(right->WorkedBy(RobotId(0))->X_WorldBase().isApprox(left->X_WorldBase()));
  EXPECT_EQ(right->placements().size(), left->placements().size());
}

TEST(Workcell, PlacesHaveNamesAndRoom) {
  const auto workcell = WorkcellFile::Read(FileOf("two-pumas"));
  const auto shared = std::ranges::find(workcell->places(), "shared", &Place::name);
  ASSERT_NE(shared, workcell->places().end());
  EXPECT_EQ(shared->room, 1);
  EXPECT_EQ(shared->radius, 0.02);
  EXPECT_TRUE(WorkcellFile::Read(FileOf("puma762-table"))->places().empty());
}

// The coarse camera serves scenarios that show what is done if a look is not enough.
TEST(Workcell, ThePumasTableHasACoarseCameraToo) {
  const auto workcell = WorkcellFile::Read(FileOf("puma762-table"));
  const SensorModel* fine = workcell->uncertainty_operations().FindSensor("overhead-camera");
  const SensorModel* coarse = workcell->uncertainty_operations().FindSensor("coarse-camera");
  ASSERT_TRUE(fine != nullptr && coarse != nullptr);
  EXPECT_LT(2 * fine->x.high, coarse->x.high);
  EXPECT_LT(2 * fine->y.high, coarse->y.high);
  EXPECT_LT(fine->theta.high, coarse->theta.high);
  EXPECT_FALSE(std::isfinite(coarse->z.high)) << "it does not measure the height";
}

// Wrong workcell files are in a folder of their own, beside copies of the robot and the gripper.
// Scenarios would find a file in the folder of the workcells.
class WrongWorkcell : public testing::Test {
 protected:
  WrongWorkcell() : folder_(ScratchFile("workcell")) {
    std::stringstream text;
    text << std::ifstream(FileOf("puma762-table")).rdbuf();
    text_ = text.str();
    std::filesystem::create_directories(folder_ / "workcells/wrong");
    const std::filesystem::path models = std::filesystem::path(ASSAY_SOURCE_DIR) / "models";
    for (const char* kind : {"robots", "grippers"}) {
      std::filesystem::copy(models / kind, folder_ / kind,
                            std::filesystem::copy_options::recursive |
                                std::filesystem::copy_options::overwrite_existing);
    }
  }
  ~WrongWorkcell() override { std::filesystem::remove_all(folder_); }

  std::string MessageWith(const std::string& old_text, const std::string& new_text) {
    std::string text = text_;
    text.replace(text.find(old_text), old_text.size(), new_text);
    const std::filesystem::path file = folder_ / "workcells/wrong/workcell.yaml";
    std::ofstream(file) << text;
    try {
      WorkcellFile::Read(file);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }

 private:
  std::filesystem::path folder_;
  std::string text_;
};

// The first file gives the robot a name and its gripper under `robots`. The others are wrong.
TEST_F(WrongWorkcell, OfSeveralRobotsIsRefused) {
  const std::string gripper = "gripper: {urdf: ../../grippers/parallel-jaw/gripper.urdf}";
  EXPECT_THAT(MessageWith("robot:\n", "robots:\n"), HasSubstr("'gripper'"));
  EXPECT_THAT(MessageWith(gripper, gripper + "\nrobots: {}"), HasSubstr("'robot'"));
}

TEST_F(WrongWorkcell, OfPlacesIsRefused) {
  const auto with = [&](const std::string& places) {
    return MessageWith("sensors:", "places: {" + places + "}\nsensors:");
  };
  EXPECT_EQ(with("a: {at: [0, 0], radius: 0.1}"), "no error");
  EXPECT_THAT(with("a: {at: [0, 0]}"), HasSubstr("missing key 'radius'"));
  EXPECT_THAT(with("a: {at: [0, 0], radius: 0}"), HasSubstr("out of range"));
  EXPECT_THAT(with("a: {at: [0, 0], radius: 0.1, room: 0}"), HasSubstr("from 1 to 100"));
  EXPECT_THAT(with("a: {at: [0, 0], radius: 0.1}, a: {at: [0, 1], radius: 0.1}"),
              HasSubstr("given twice"));
}

TEST_F(WrongWorkcell, IsRefused) {
  EXPECT_EQ(MessageWith("tool_lean", "tool_lean"), "no error");
  EXPECT_THAT(MessageWith("tool_lean", "toollean"), HasSubstr("missing key 'tool_lean'"));
  EXPECT_THAT(MessageWith("rules:\n", "rules:\n  gap: 3\n"), HasSubstr("unknown name 'gap'"));
  EXPECT_THAT(MessageWith("safe_height: 0.40", "safe_height: -1"),
              HasSubstr("-1 m is out of range; allowed: 0.01 m to 2 m"));
  EXPECT_THAT(MessageWith("puma762.urdf", "puma763.urdf"), HasSubstr("there is no file"));
  EXPECT_THAT(
      MessageWith("196.7716", "300"),
      HasSubstr("outside the joint limits; allowed: for joints 1 to 6: -160 deg to 160 deg, -200 "
                "deg to 20 deg, -45 "
                "deg to 225 deg, -266 deg to 266 deg, -100 deg to 100 deg, -266 deg to 266 deg"));
  EXPECT_THAT(MessageWith("[90, 150", "[90, 0"),
              HasSubstr("0 deg/s^2, which is not positive; allowed: six numbers above 0 deg/s^2"));
  EXPECT_THAT(MessageWith("[0.30, 1.05]", "[1.05, 0.30]"), HasSubstr("the range goes down"));
  EXPECT_THAT(MessageWith("[0.30, 1.05]", "[0.30, 0.30]"), HasSubstr("no area"));
  EXPECT_THAT(MessageWith("step: 0.10", "step: 0.001"), HasSubstr("601 places"));
  EXPECT_THAT(MessageWith("sensors:", "sensrs:"), HasSubstr("did you mean 'sensors'"));
  EXPECT_THAT(MessageWith("pad_margin: 0.001", "pad_margin: 1"),
              HasSubstr("1 m is out of range; allowed: 0 m to 0.01 m"));
  EXPECT_THAT(MessageWith("yaws: 12", "yaws: 0"), HasSubstr("from 1 to 72"));
  EXPECT_THAT(MessageWith("[0, 0, 1], [-0.15, 0, 0.70]", "[0, 0, 2], [-0.15, 0, 0.70]"),
              HasSubstr("is no component of a unit vector"));
}

}  // namespace
}  // namespace assay::domain::workcell_test
