#include "planner/domain/parts/look_alike.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "tests/planner/domain/scenario.h"

namespace assay::domain::look_alike_test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Interval kAnything = {-kInfinity, kInfinity};

// A camera like that of the workcells.
const SensorModel kCamera = {.name = "camera",
                             .description = "",
                             .x = {-0.0003, 0.0003},
                             .y = {-0.0003, 0.0003},
                             .z = kAnything,
                             .theta = {-0.2 * kDegree, 0.2 * kDegree}};
const PoseError kNoError = {{0, 0}, {0, 0}, {0, 0}, {0, 0}};
const PoseError kMillimetres = {{-0.002, 0.002}, {-0.002, 0.002}, {0, 0}, {-0.03, 0.03}};

// A brick of 2 x 2 x 4 inches, and a peg that looks different from every side.
class Looking : public testing::Test {
 protected:
  static Part PartOf(const std::string& name, const PoseError& error) {
    const Problem problem = LoadScenario(name == "brick" ? "clutter" : "spar-fig15");
    Part part = problem.part(PartNamed(problem, name));
    part.error = error;
    return part;
  }
  static Pose Standing(const Part& part, const std::string& stable, double x, double y,
                       double yaw) {
    const auto& poses = part.model->stable_poses();
    const auto found = std::ranges::find(poses, stable, &StablePose::name);
    EXPECT_NE(found, poses.end());
    return Placement{.x = x, .y = y, .yaw = yaw}.X_WorldTable() * found->X_TablePart;
  }
};

TEST_F(Looking, PlacesAreToldApartBeyondErrorsAndPromise) {
  const Part exact = PartOf("peg", kNoError);
  const Part uncertain = PartOf("peg", kMillimetres);
  const auto is_like = [](const Part& part, double x, double yaw) {
    return LookAlike(part, Standing(part, "on-side", 0.5, 0.1, 0.3),
                     Standing(part, "on-side", 0.5 + x, 0.1, 0.3 + yaw), kCamera);
  };
  EXPECT_TRUE(is_like(exact, 0.0005, 0));
  EXPECT_FALSE(is_like(exact, 0.0010, 0));
  EXPECT_TRUE(is_like(uncertain, 0.0040, 0));
  EXPECT_FALSE(is_like(uncertain, 0.0050, 0));
  EXPECT_TRUE(is_like(exact, 0, 0.3 * kDegree));
  EXPECT_FALSE(is_like(exact, 0, 1 * kDegree));
  EXPECT_TRUE(is_like(uncertain, 0.003, 3 * kDegree));
  EXPECT_FALSE(is_like(uncertain, 0.003, 5 * kDegree));
}

TEST_F(Looking, SymmetriesLookTheSame) {
  const Part brick = PartOf("brick", kNoError);
  const Pose upright = Standing(brick, "upright", 0.5, 0.1, 0.3);
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double yaw = 0.3 + quarter * std::numbers::pi / 2;
    EXPECT_TRUE(LookAlike(brick, upright, Standing(brick, "upright", 0.5, 0.1, yaw), kCamera));
    EXPECT_TRUE(LookAlike(brick, upright, Standing(brick, "upside-down", 0.5, 0.1, yaw), kCamera));
  }
  EXPECT_FALSE(LookAlike(brick, upright, Standing(brick, "upright", 0.5, 0.1, 0.8), kCamera));
  EXPECT_FALSE(LookAlike(brick, upright, Standing(brick, "on-front", 0.5, 0.1, 0.3), kCamera));
  const Part peg = PartOf("peg", kMillimetres);
  EXPECT_FALSE(LookAlike(peg, Standing(peg, "shaft-up", 0.5, 0.1, 0),
                         Standing(peg, "shaft-down", 0.5, 0.1, 0), kCamera));
}

// Poses that differ only in what the sensor does not measure look alike.
TEST_F(Looking, AnAngleSensorTellsNoPlaces) {
  const Part peg = PartOf("peg", kNoError);
  SensorModel compass = kCamera;
  compass.x = compass.y = kAnything;
  EXPECT_TRUE(LookAlike(peg, Standing(peg, "on-side", 0.5, 0.1, 0.3),
                        Standing(peg, "on-side", 0.7, -0.1, 0.3), compass));
  EXPECT_FALSE(LookAlike(peg, Standing(peg, "on-side", 0.5, 0.1, 0.3),
                         Standing(peg, "on-side", 0.5, 0.1, 0.4), compass));
}

}  // namespace
}  // namespace assay::domain::look_alike_test
