#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "planner/base/input_files/input_error.h"
#include "planner/domain/matings/mating_classes.h"
#include "planner/geometry/pose.h"
#include "tests/planner/domain/scenario.h"
#include "tests/scratch_file.h"

namespace assay::domain::through_hole_test {
namespace {

constexpr char kPlate[] = R"(
format: assay-part/1
name: plate
initial: P
units: {length: mm, angle: degree}
density: 2700
friction: 0.25
solids:
  plate: {box: [[-40, -40, 0], [40, 40, 30]]}
pockets:
  hole: {cut_from: plate, box: [[-10, -10, 0], [10, 10, 30]], widen: [x, y]}
features:
  1: {hole: hole, axis: +z, what: square hole}
stable_poses: {face-up: -z, face-down: +z}
)";

constexpr char kPin[] = R"(
format: assay-part/1
name: pin
initial: I
units: {length: mm, angle: degree}
density: 2700
friction: 0.25
solids:
  head: {box: [[-30, -20, 0], [30, 20, 40]]}
  shaft: {box: [[-10, -10, -60], [10, 10, 0]]}
features:
  1: {shaft: shaft, axis: -z, what: square shaft}
)";

void Write(const std::string& part, const std::string& text) {
  const std::filesystem::path folder = ScratchFile("models") / "parts" / part;
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "part.yaml") << text;
}

// Returns a scenario in which the tip ends at this height over the far side of the plate. The
// motion of this length starts 20 mm before the mouth if none is given.
Problem WithTipAt(double height_mm, std::optional<double> length_mm = {}) {
  Write("plate", kPlate);
  Write("pin", kPin);
  const std::string text = R"(
format: assay-scenario/1
units: {length: mm, angle: degree}
workcell: puma762-table
clearance: 0.5
parts:
  plate: {model: plate, pose: {stable: face-up, at: [600, 50]}}
  pin: {model: pin, pose: {columns: [[1, 0, 0], [0, -1, 0], [0, 0, -1], [500, -200, 40]]}}
goal:
  - assembled:
      held: pin
      fixed: plate
      features: [[1], [1]]
      pose: {columns: [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, )" +
                           std::to_string(60 + height_mm) + R"(]]}
      mating_vector: [0, 0, )" +
                           std::to_string(-length_mm.value_or(50 - height_mm)) + R"(]
)";
  ModelPath models(ScratchFile("models"));
  models.Append(ModelsFolder());
  return ReadProblem(Document::Parse(text, "scenario.yaml"), models);
}

TEST(ThroughHole, TheTableUnderThePlateStopsTheShaft) {
  const Problem problem = WithTipAt(0);
  EXPECT_TRUE(problem.matings.at(0).ends_on_table);
  EXPECT_FALSE(LoadScenario("spar-fig13").matings.at(0).ends_on_table);
}

TEST(ThroughHole, NothingStopsAShaftThatEndsElsewhere) {
  for (const double height : {-5.0, -0.3, 0.3, 5.0})
    EXPECT_THROW(WithTipAt(height), InputError) << height;
}

// The hole must open upward, and the table may cover its other mouth.
TEST(ThroughHole, ThePlateLiesWithItsHoleUp) {
  const Problem problem = WithTipAt(0);
  const Mating& mating = problem.matings[0];
  const auto& poses = problem.part(mating.fixed).model->stable_poses();
  int allowed = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const bool allows = !HidesMatingFeatures(problem, mating, StablePoseId(i)) &&
                        InFrictionCone(problem, mating, poses[i].X_TablePart);
    EXPECT_EQ(allows, poses[i].name == "face-up") << poses[i].label;
    allowed += allows ? 1 : 0;
  }
  EXPECT_EQ(allowed, 1);
  EXPECT_EQ(PositionList(problem, mating).size(), 2U);  // that pose, and the start
}

// A friction cone does not help where the table must stop the shaft: straight down, at its height.
TEST(ThroughHole, TheMotionGoesStraightDownToTheTable) {
  const Problem problem = WithTipAt(0);
  const Mating& mating = problem.matings[0];
  EXPECT_TRUE(InFrictionCone(problem, mating, Pose::Identity()));
  EXPECT_FALSE(InFrictionCone(problem, mating, geometry::Translation(0, 0, 0.001)));
  EXPECT_FALSE(InFrictionCone(problem, mating, geometry::RotationX(0.01)));
}

// The head lies on the plate, and the tip is 30 mm below the plate.
TEST(ThroughHole, AShaftThatIsLongerThanItsHoleNeedsRoomBelow) {
  const Problem problem = WithTipAt(-30);
  const Mating& mating = problem.matings[0];
  EXPECT_FALSE(mating.ends_on_table);
  EXPECT_NEAR(HeightOfMated(problem, mating, Pose::Identity()), -0.030, 1e-9);
  EXPECT_FALSE(InFrictionCone(problem, mating, Pose::Identity()));
  EXPECT_FALSE(InFrictionCone(problem, mating, geometry::Translation(0, 0, 0.0298)));
  EXPECT_TRUE(InFrictionCone(problem, mating, geometry::Translation(0, 0, 0.0302)));
}

// A hand cannot bring the pin to where its tip is in the mouth without touching the plate.
TEST(ThroughHole, TheMotionStartsBeforeTheMouth) {
  for (const double length_mm : {30.0, 33.0, 35.0, 36.0, 50.0}) {
    const Problem problem = WithTipAt(0, length_mm);
    EXPECT_NEAR(problem.matings[0].mating_vector.z(), -1e-3 * std::max(length_mm, 35.0), 1e-12)
        << length_mm;
  }
  EXPECT_THROW(WithTipAt(0, 29.0), InputError);
}

}  // namespace
}  // namespace assay::domain::through_hole_test
