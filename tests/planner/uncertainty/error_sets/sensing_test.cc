#include "planner/uncertainty/error_sets/sensing.h"

#include <gtest/gtest.h>

#include "tests/planner/uncertainty/part_on_table.h"

namespace assay::uncertainty::sensing_test {
namespace {

// The coarse camera of the workcell promises 0.3 mm and 0.2 degrees. It does not measure the
// height.
constexpr double kCamera = 0.0003;
constexpr double kCameraAngle = 0.2 * kDegree;

plan::ErrorSet AfterALook(const domain::Problem& problem, Propagation mode) {
  UncertainWorld world(problem, mode);
  ApplySensing(world, kBlock, "coarse-camera");
  return ErrorSetOf(world, kBlock);
}

TEST(Sensing, LeavesTheSensorsPromiseAndWhatItDoesNotMeasure) {
  const plan::ErrorSet set = AfterALook(UprightBlock({}), Propagation::kPaper);
  EXPECT_NEAR(set.x.high, kCamera, 1e-12);
  EXPECT_NEAR(set.y.low, -kCamera, 1e-12);
  EXPECT_NEAR(set.z.high, 0.002, 1e-12);
  EXPECT_NEAR(set.theta.high, kCameraAngle, 1e-12);
}

TEST(Sensing, TellsNothingAboutWhatIsKnownBetter) {
  domain::Problem problem = UprightBlock({});
  problem.parts[kBlock.index()].error.x = {-0.0001, 0.0001};
  const plan::ErrorSet set = AfterALook(problem, Propagation::kPaper);
  EXPECT_NEAR(set.x.high, 0.0001, 1e-12);
  EXPECT_NEAR(set.y.high, kCamera, 1e-12);
}

// The sensor promises errors along the world's axes, and the certificate states them along these
// axes. In the frame of the plan these axes are turned by the change of the believed yaw.
TEST(Sensing, InSoundModeTheSensorsAxesTurnWithTheBelief) {
  const Errors errors;
  const domain::Problem problem = UprightBlock(errors);
  UncertainWorld world(problem, Propagation::kSound);
  ApplySensing(world, kBlock, "coarse-camera");
  const plan::ErrorSet set = ErrorSetOf(world, kBlock);
  EXPECT_NEAR(set.x.high, kCamera, 1e-12);
  EXPECT_NEAR(set.y.low, -kCamera, 1e-12);
  const double turn = errors.angle + kCameraAngle;
  const double exact = kCamera * (std::cos(turn) + std::sin(turn));
  const Interval x = world.TightRangeOf(world.resting(kBlock).displacement[0]);
  EXPECT_NEAR(x.high, exact, 1e-6);
  EXPECT_GE(x.high, exact - 1e-15);
}

TEST(Sensing, AgainTellsNothingNew) {
  const domain::Problem problem = UprightBlock({});
  UncertainWorld world(problem, Propagation::kSound);
  ApplySensing(world, kBlock, "coarse-camera");
  const plan::ErrorSet once = ErrorSetOf(world, kBlock);
  ApplySensing(world, kBlock, "coarse-camera");
  EXPECT_EQ(ErrorSetOf(world, kBlock), once);
}

}  // namespace
}  // namespace assay::uncertainty::sensing_test
