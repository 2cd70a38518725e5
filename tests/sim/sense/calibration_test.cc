#include "sim/sense/calibration.h"

#include <gtest/gtest.h>

#include <set>

#include "planner/domain/resting/resting.h"
#include "sim/scene/scene.h"
#include "tests/sim/scene/peg_and_block.h"

namespace assay::sense::calibration_test {
namespace {

class CalibrationTest : public testing::Test {
 protected:
  const domain::Problem problem = scene::PegAndBlock();
};

TEST_F(CalibrationTest, PlacementsAreOnTheTableAndApart) {
  std::set<std::pair<int, int>> seen;
  for (int number = 1; number <= 300; ++number) {
    const auto placement = DrawCalibrationPlacement(problem, 5, number);
    ASSERT_TRUE(placement);
    const PartId part = placement->part;
    Pose at_rest = placement->X_WorldPart[part.index()];
    at_rest.translation().z() -= placement->displacement[2];
    EXPECT_TRUE(domain::OnTable(problem, part, at_rest));
    EXPECT_EQ(domain::StablePoseAt(problem.part(part), at_rest), placement->resting);
    const PartId other(1 - part.index());
    const std::vector<domain::PlacedPart> others = {
        {.part = other, .X_WorldPart = placement->X_WorldPart[other.index()]}};
    EXPECT_TRUE(domain::Crowding(problem, part, at_rest, others).IsNone());
    seen.emplace(part.index(), placement->resting.index());
  }
  EXPECT_EQ(seen.size(), problem.parts[0].model->stable_poses().size() +
                             problem.parts[1].model->stable_poses().size());
}

TEST_F(CalibrationTest, EvenNumbersAreCornersAndOddOnesAreWithin) {
  const Displacement& bounds = CalibratedDisplacement();
  for (int number = 1; number <= 100; ++number) {
    const auto placement = DrawCalibrationPlacement(problem, 5, number);
    const Pose& truth = placement->X_WorldPart[placement->part.index()];
    EXPECT_TRUE(Displaced(placement->Believed(), placement->displacement).isApprox(truth, 1e-12));
    for (int i = 0; i < 4; ++i) {
      const double size = std::abs(placement->displacement[i]);
      EXPECT_LE(size, bounds[i]);
      EXPECT_EQ(size == bounds[i], number % 2 == 0);
    }
  }
}

TEST_F(CalibrationTest, APlacementDependsOnSeedAndNumberAlone) {
  const auto once = DrawCalibrationPlacement(problem, 5, 17);
  const auto again = DrawCalibrationPlacement(problem, 5, 17);
  const auto other = DrawCalibrationPlacement(problem, 6, 17);
  EXPECT_EQ(once->displacement, again->displacement);
  EXPECT_EQ(once->X_WorldPart[0].matrix(), again->X_WorldPart[0].matrix());
  EXPECT_NE(once->X_WorldPart[0].matrix(), other->X_WorldPart[0].matrix());
}

// A sensor that always has the same error, or finds nothing.
class WrongSensor : public PoseSensor {
 public:
  WrongSensor(const CalibrationPlacement& placement, const std::optional<Displacement>& error)
      : placement_(placement), error_(error) {}

  std::optional<Pose> Measure(const mujoco::Data&, PartId part, const Pose&) override {
    if (!error_) return std::nullopt;
    return Displaced(placement_.X_WorldPart[part.index()], -*error_);
  }

 private:
  const CalibrationPlacement& placement_;
  std::optional<Displacement> error_;
};

TEST_F(CalibrationTest, ErrorsAreTrueMinusMeasured) {
  const scene::Scene scene(problem, {});
  const auto placement = DrawCalibrationPlacement(problem, 5, 3);
  const Displacement error(0.0001, -0.0002, 0.0003, 0.004);
  WrongSensor wrong(*placement, error);
  const auto measured = MeasuredError(scene, *placement, wrong);
  ASSERT_TRUE(measured);
  EXPECT_NEAR((*measured - error).norm(), 0, 1e-12);
  WrongSensor blind(*placement, std::nullopt);
  EXPECT_FALSE(MeasuredError(scene, *placement, blind));
}

TEST(Promise, IsKeptUpToItsBounds) {
  domain::SensorModel promise;
  promise.x = {-0.0003, 0.0003};
  promise.y = {-0.0001, 0.0003};
  promise.z = {-1e9, 1e9};
  promise.theta = {-0.003, 0.003};
  EXPECT_TRUE(KeepsPromise(promise, {0.0003, -0.0001, 0.1, -0.003}));
  EXPECT_FALSE(KeepsPromise(promise, {0.00031, 0, 0, 0}));
  EXPECT_FALSE(KeepsPromise(promise, {0, -0.0002, 0, 0}));
  EXPECT_FALSE(KeepsPromise(promise, {0, 0, 0, 0.0031}));
}

}  // namespace
}  // namespace assay::sense::calibration_test
