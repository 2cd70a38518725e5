#include "sim/sense/color_sensor.h"

#include <gtest/gtest.h>

#include "planner/base/random.h"
#include "planner/domain/problem/problem_file.h"
#include "planner/geometry/pose.h"
#include "sim/sense/displacement.h"

namespace assay::sense::color_sensor_test {
namespace {

const std::vector<NamedColor> kColors = {{"full", {0.16, 0.45, 0.22}},
                                         {"empty", {0.65, 0.82, 0.95}}};
constexpr ColorId kFull(0);
constexpr ColorId kEmpty(1);
constexpr PartId kBottle(0);
constexpr PartId kNeighbour(1);

domain::Problem TwoBottles() {
  return domain::ReadProblem(
      Document::Parse("format: assay-scenario/1\n"
                      "workcell: two-pumas\n"
                      "parts:\n"
                      "  bottle: {model: bottle, pose: {stable: upright, at: [-0.4, 0.1]}}\n"
                      "  neighbour: {model: bottle, pose: {stable: upright, at: [0.4, 0.1]}}\n"
                      "goal: [{located: {part: bottle, stable: [upright]}}]\n",
                      "bottles.yaml"),
      ASSAY_SOURCE_DIR "/models");
}

Eigen::Vector4d Opaque(const Color& color) { return {color[0], color[1], color[2], 1}; }

// Two bottles in some light. The first has the given colour and the second has the other one.
struct Cell {
  domain::Problem problem = TwoBottles();
  scene::Scene scene;
  ColorSensor sensor;
  mujoco::Data data;

  Cell(ColorId color, double light)
      : scene(problem, {.part_colors = {{kBottle, Opaque(kColors[color.index()].color)},
                                        {kNeighbour, Opaque(kColors[1 - color.index()].color)}},
                        .light = light}),
        sensor(scene, problem, kColors),
        data(scene.Start()) {}

  Pose Upright(double x, double y, double yaw) const {
    const domain::Part& part = problem.part(kBottle);
    return domain::Placement{x, y, yaw}.X_WorldTable() *
           part.model->stable_poses()[part.resting.index()].X_TablePart;
  }
  ColorId LookAt(const Pose& X_WorldPart, const Displacement& error) {
    scene.SetPart(data, kBottle, X_WorldPart);
    return sensor.Measure(data, kBottle, Displaced(X_WorldPart, error));
  }
};

class ColorSensorTest : public testing::Test {
 protected:
  void SetUp() override {
    if (render::AvailableRenderer().empty()) GTEST_SKIP() << "nothing renders on this machine";
  }
};

// The sensor promises the right colour all over the table, for any light and for any error within
// its window.
TEST_F(ColorSensorTest, TellsTheColorEverywhere) {
  RandomStream random(31, "places");
  constexpr SearchWindow kWindow = ColorSensor::kWindow;
  for (const double light : {0.5, 1.0, 1.5}) {
    for (const ColorId color : {kFull, kEmpty}) {
      Cell cell(color, light);
      for (int i = 0; i < 5; ++i) {
        const Pose X = cell.Upright(random.Uniform(-0.5, 0.3), random.Uniform(-0.35, 0.35),
                                    random.Uniform(-3, 3));
        const Displacement error(random.Uniform(-kWindow.distance, kWindow.distance),
                                 random.Uniform(-kWindow.distance, kWindow.distance),
                                 random.Uniform(-kWindow.height, kWindow.height),
                                 random.Uniform(-kWindow.yaw, kWindow.yaw));
        EXPECT_EQ(cell.LookAt(X, error), color)
            << X.translation().transpose() << ", off by " << error.transpose() << ", light "
            << light << ": " << cell.sensor.Shares(cell.data, kBottle, Displaced(X, error))[0]
            << " " << cell.sensor.Shares(cell.data, kBottle, Displaced(X, error))[1];
      }
    }
  }
}

TEST_F(ColorSensorTest, CannotTellWhatIsNotThere) {
  Cell cell(kFull, 1);
  const Pose elsewhere = cell.Upright(0, -0.3, 0);
  cell.scene.SetPart(cell.data, kBottle, cell.Upright(-0.4, 0.1, 0));
  EXPECT_TRUE(cell.sensor.Measure(cell.data, kBottle, elsewhere).IsNone());
}

// The bottle has a colour that is not one of the named ones.
TEST_F(ColorSensorTest, CannotTellAColorItDoesNotKnow) {
  const domain::Problem problem = TwoBottles();
  const scene::Scene scene(problem, {.part_colors = {{kBottle, {0.8, 0.2, 0.15, 1}}}});
  ColorSensor sensor(scene, problem, kColors);
  const mujoco::Data data = scene.Start();
  EXPECT_TRUE(sensor.Measure(data, kBottle, problem.part(kBottle).X_WorldPart).IsNone());
}

// The arm is in random postures about the bottle. It may go through the bottle in the picture. The
// wrong colour is never reported. No colour is reported if hand and forearm hide most of the
// bottle.
TEST_F(ColorSensorTest, AnArmInTheWayHidesIt) {
  Cell cell(kEmpty, 1);
  const Pose X = cell.Upright(-0.4, 0.0, 0);
  EXPECT_EQ(cell.LookAt(X, Displacement::Zero()), kEmpty);
  const domain::Workcell& workcell = *cell.problem.workcell;
  RandomStream random(32, "postures");
  int hidden = 0;
  for (int i = 0; i < 40; ++i) {
    const Pose flange = geometry::Translation(random.Uniform(-0.5, -0.3), random.Uniform(-0.1, 0.1),
                                              random.Uniform(0, 0.3)) *
                        geometry::RotationY(random.Uniform(-3, 3)) *
                        geometry::RotationX(random.Uniform(-3, 3));
    const auto solutions = workcell.arm().Inverse(workcell.X_WorldBase().inverse() * flange);
    if (solutions.empty()) continue;
    cell.scene.SetArm(cell.data, solutions[0].q);
    const ColorId told = cell.sensor.Measure(cell.data, kBottle, X);
    EXPECT_NE(told, kFull);
    hidden += told.IsNone();
  }
  EXPECT_GT(hidden, 0);
}

TEST_F(ColorSensorTest, TheSameSightGivesTheSameShares) {
  Cell cell(kFull, 1);
  const Pose X = cell.problem.part(kBottle).X_WorldPart;
  const auto first = cell.sensor.Shares(cell.data, kBottle, X);
  cell.sensor.Shares(cell.data, kNeighbour, cell.problem.part(kNeighbour).X_WorldPart);
  EXPECT_EQ(cell.sensor.Shares(cell.data, kBottle, X), first);
  EXPECT_EQ(ColorSensor(cell.scene, cell.problem, kColors).Shares(cell.data, kBottle, X), first);
}

}  // namespace
}  // namespace assay::sense::color_sensor_test
