#include "sim/noise/error_box.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/planner/plan/actions.h"
#include "tests/sim/noise/figure15_careful.h"

namespace assay::noise::error_box_test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Not;

constexpr double kInch = 0.0254;
constexpr double kDegree = std::numbers::pi / 180;

std::vector<std::string> Names(const std::vector<Channel>& box) {
  std::vector<std::string> names;
  for (const Channel& channel : box) names.push_back(channel.name);
  return names;
}

class ErrorBoxTest : public testing::Test {
 protected:
  ErrorBoxTest() : problem_(Figure15()), plan_(OneOfEachStep(problem_)) {}

  std::vector<Channel> Box() const { return ErrorBox(problem_, plan_); }
  // Returns the only channel with this name.
  Channel At(const std::string& name) const {
    std::vector<Channel> found;
    for (const Channel& channel : Box()) {
      if (channel.name == name) found.push_back(channel);
    }
    EXPECT_EQ(found.size(), 1u) << name;
    return found.empty() ? Channel{} : found.front();
  }
  void ExpectRange(const std::string& name, double low, double high) const {
    EXPECT_NEAR(At(name).range.low, low, 1e-15) << name;
    EXPECT_NEAR(At(name).range.high, high, 1e-15) << name;
  }

  domain::Problem problem_;
  plan::Plan plan_;
};

// The channels of parts come first, and then those of each step in the order of execution. A look
// draws the sensor's errors, each manipulation draws the hand's errors anew, and a putdown draws
// the table's height.
TEST_F(ErrorBoxTest, HasEveryErrorThatThePlannerAssumes) {
  EXPECT_THAT(
      Names(Box()),
      ElementsAre("dx_block", "dy_block", "dz_block", "theta_block",  //
                  "dx_peg", "dy_peg", "dz_peg", "theta_peg",          //
                  "dx_sensed@action_6", "dy_sensed@action_6", "dz_sensed@action_6",
                  "theta_sensed@action_6",  //
                  "dx_hand@action_5", "dy_hand@action_5", "dz_hand@action_5", "theta_hand@action_5",
                  "dx_hand@action_4", "dy_hand@action_4", "dz_hand@action_4", "theta_hand@action_4",
                  "dx_hand@action_3", "dy_hand@action_3", "dz_hand@action_3", "theta_hand@action_3",
                  "dz_peg@action_3",  //
                  "dx_hand@action_2", "dy_hand@action_2", "dz_hand@action_2", "theta_hand@action_2",
                  "dx_hand@action_1", "dy_hand@action_1", "dz_hand@action_1",
                  "theta_hand@action_1"));
}

TEST_F(ErrorBoxTest, ACameraThatTellsNothingOfHeightsCannotErrInThem) {
  for (plan::PlannedStep& step : plan_.steps) {
    if (auto* look = As(domain::kSense, step.action)) look->sensor = "coarse-camera";
  }
  EXPECT_THAT(Names(Box()), Contains("dy_sensed@action_6"));
  EXPECT_THAT(Names(Box()), Not(Contains("dz_sensed@action_6")));
}

// The scenario file says 0.11 inch and 5.5 degrees for parts, and a thousandth of an inch and of a
// degree for the hand.
TEST_F(ErrorBoxTest, HasTheBoundsOfTheScenario) {
  for (const char* part : {"block", "peg"}) {
    for (const char* axis : {"dx_", "dy_", "dz_"}) {
      ExpectRange(std::string(axis) + part, -0.11 * kInch, 0.11 * kInch);
    }
    ExpectRange(std::string("theta_") + part, -5.5 * kDegree, 5.5 * kDegree);
  }
  for (const char* step : {"1", "2", "3", "4", "5"}) {
    for (const char* axis : {"dx", "dy", "dz"}) {
      ExpectRange(std::string(axis) + "_hand@action_" + step, -0.001 * kInch, 0.001 * kInch);
    }
    ExpectRange(std::string("theta_hand@action_") + step, -0.001 * kDegree, 0.001 * kDegree);
  }
  ExpectRange("dz_peg@action_3", -0.11 * kInch, 0.11 * kInch);
}

// The sensor's ranges are those of the workcell file.
TEST_F(ErrorBoxTest, HasThePromisesOfTheSensor) {
  const domain::SensorModel& camera =
      *problem_.workcell->uncertainty_operations().FindSensor("overhead-camera");
  EXPECT_EQ(At("dx_sensed@action_6").range, camera.x);
  EXPECT_EQ(At("dy_sensed@action_6").range, camera.y);
  EXPECT_EQ(At("dz_sensed@action_6").range, camera.z);
  EXPECT_EQ(At("theta_sensed@action_6").range, camera.theta);
}

// The ranges are the intervals of the problem that the planner used, even if they are not
// symmetric.
TEST_F(ErrorBoxTest, TakesTheProblemsOwnIntervals) {
  problem_.parts[1].error.y = {-0.001, 0.004};
  problem_.gripper_error.theta = {0, 0.01};
  EXPECT_EQ(At("dy_peg").range, problem_.parts[1].error.y);
  EXPECT_EQ(At("theta_hand@action_1").range, problem_.gripper_error.theta);
}

TEST_F(ErrorBoxTest, SaysWhatEachErrorIsOf) {
  EXPECT_EQ(At("dy_block").effect, Effect::kPartY);
  EXPECT_EQ(At("dy_block").part, kBlock);
  EXPECT_TRUE(At("dy_block").step.IsNone());
  EXPECT_EQ(At("dz_peg").effect, Effect::kTableHeight);
  EXPECT_TRUE(At("dz_peg").step.IsNone());
  EXPECT_EQ(At("theta_sensed@action_6").effect, Effect::kSensedYaw);
  EXPECT_EQ(At("theta_sensed@action_6").step, StepId(5));
  EXPECT_EQ(At("dz_peg@action_3").effect, Effect::kTableHeight);
  EXPECT_EQ(At("dz_peg@action_3").part, kPeg);
  EXPECT_EQ(At("dz_peg@action_3").step, StepId(2));
  EXPECT_EQ(At("dz_hand@action_1").effect, Effect::kHandZ);
  EXPECT_TRUE(At("dz_hand@action_1").part.IsNone());
}

TEST_F(ErrorBoxTest, LeavesOutWhatHasNoWidth) {
  problem_.parts[0].error = {};
  problem_.parts[1].error.z = {};
  problem_.gripper_error.x = {};
  const std::vector<std::string> names = Names(Box());
  EXPECT_EQ(names.size(), 33u - 4 - 2 - 5);
  for (const std::string& name : names) {
    EXPECT_FALSE(name.starts_with("d") && name.ends_with("_block")) << name;
    EXPECT_FALSE(name.starts_with("dz_peg") || name.starts_with("dx_hand")) << name;
  }
}

TEST_F(ErrorBoxTest, HasTheTolerancesOfTheWorkcell) {
  problem_.tolerances = {.clearance = 1e-4, .friction = 0.05, .pad_friction = 0.02};
  ExpectRange("clearance", -1e-4, 1e-4);
  ExpectRange("friction", -0.05, 0.05);
  ExpectRange("pad_friction", -0.02, 0.02);
  EXPECT_EQ(At("pad_friction").effect, Effect::kPadFriction);
  EXPECT_TRUE(At("friction").part.IsNone() && At("friction").step.IsNone());
}

}  // namespace
}  // namespace assay::noise::error_box_test
