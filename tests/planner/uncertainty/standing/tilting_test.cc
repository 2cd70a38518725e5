#include "planner/uncertainty/standing/tilting.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>
#include <vector>

#include "planner/domain/parts/part_file.h"
#include "planner/domain/parts/part_model.h"
#include "tests/planner/uncertainty/part_on_table.h"
#include "tests/scratch_file.h"

namespace assay::uncertainty::tilting_test {
namespace {

// A block that is tilted about a corner of its lower side, so that nothing of it is below the
// table, moves the grasped point by no more than the bound. Some blocks use most of the bound.
TEST(MovedByTilt, BoundsTheWayAboutEachCornerOfTheSupport) {
  const domain::Problem problem = UprightBlock({});
  const UncertainWorld world(problem, Propagation::kSound);
  const Pose& X_WorldPart = world.X_WorldPart(kBlock);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(-1, 1);
  double most_of_bound = 0;
  for (int i = 0; i < 2000; ++i) {
    plan::Hold hold = HoldFromAbove(problem, Vector3::UnitY());
    hold.X_PartTool.rotate(Eigen::AngleAxisd(1.2 * share(random), Vector3::UnitY()));
    hold.X_PartTool.translation() += 0.03 * Vector3(share(random), share(random), share(random));
    const Pose X_WorldTool = X_WorldPart * hold.X_PartTool;
    const double tilt = 1e-3 * share(random);
    const Vector3 bound = MovedByTilt(world, kBlock, hold, std::abs(tilt), 0);
    const Vector3 axis =
        Vector3::UnitZ().cross(X_WorldTool.linear().col(2).cross(Vector3::UnitZ()));
    const Eigen::AngleAxisd turn(tilt, axis.normalized());
    for (const Vector3& corner : problem.part(kBlock).model->corners()) {
      const Vector3 about = X_WorldPart * corner;
      if (std::abs(about.z()) > 1e-9) continue;
      const auto moved = [&](const Vector3& p) -> Vector3 { return turn * (p - about) + about; };
      bool stands = true;
      for (const Vector3& other : problem.part(kBlock).model->corners())
        stands = stands && moved(X_WorldPart * other).z() > -1e-9;
      if (!stands) continue;
      const Vector3 grasped = X_WorldTool.translation();
      const Vector3 way = X_WorldTool.linear().transpose() * (moved(grasped) - grasped);
      EXPECT_TRUE((way.cwiseAbs().array() <= bound.array() * (1 + 1e-3) + 1e-9).all())
          << way.transpose() << " beyond " << bound.transpose();
      most_of_bound = std::max(most_of_bound, std::abs(way.x()) / bound.x());
    }
  }
  EXPECT_GT(most_of_bound, 0.9);
}

struct Box {
  Vector3 low;
  Vector3 high;
};
const std::vector<Box> kBoxes = {{{-0.02, -0.02, 0}, {0.02, 0.02, 0.08}},
                                 {{0.02, -0.01, 0.05}, {0.06, 0.03, 0.07}}};

// Returns a problem with an upright bar. An arm high on one side gives it products of inertia.
domain::Problem BarWithArm() {
  const auto file = ScratchFile("bar.yaml");
  std::ofstream(file) << R"(format: assay-part/1
name: bar
initial: B
units: {length: mm, angle: degree}
density: 700
friction: 0.3
solids:
  bar: {box: [[-20, -20, 0], [20, 20, 80]]}
  arm: {box: [[20, -10, 50], [60, 30, 70]]}
features:
  1: {face: bar, normal: +z, what: top}
)";
  domain::Problem problem = UprightBlock({});
  problem.parts[kBlock.index()].model = domain::PartFile::Load(file, 0.001);
  return problem;
}

// Returns the angular momentum about the vertical through a point, by a sum over small cubes.
double VerticalMomentum(const Vector3& point, const Vector3& omega) {
  constexpr double kSide = 0.002;
  double sum = 0;
  for (const Box& box : kBoxes) {
    for (double x = box.low.x() + kSide / 2; x < box.high.x(); x += kSide) {
      for (double y = box.low.y() + kSide / 2; y < box.high.y(); y += kSide) {
        for (double z = box.low.z() + kSide / 2; z < box.high.z(); z += kSide) {
          const Vector3 arm = Vector3(x, y, z) - point;
          sum += arm.cross(omega.cross(arm)).z();
        }
      }
    }
  }
  return sum;
}

// A part that falls about any horizontal axis, without momentum about the vertical through its
// centre of mass or through a corner of its support, turns by no more than the bound. For one of
// the corners and axes, it turns by almost as much.
TEST(TurnByFall, KeepsTheMomentumAboutTheVerticalAtZero) {
  const domain::Problem problem = BarWithArm();
  const UncertainWorld world(problem, Propagation::kSound);
  const domain::PartModel& model = *problem.part(kBlock).model;
  std::vector<Vector3> points = {model.mass().center};
  for (const Vector3& corner : model.corners()) {
    if (corner.z() < 1e-9) points.push_back(corner);
  }
  ASSERT_EQ(points.size(), 5u);
  double most = 0;
  for (const Vector3& point : points) {
    const double by_spin = VerticalMomentum(point, Vector3::UnitZ());
    for (double axis = 0; axis < 3.15; axis += 0.1) {
      const double by_fall = VerticalMomentum(point, Vector3(std::cos(axis), std::sin(axis), 0));
      most = std::max(most, std::abs(by_fall / by_spin));
    }
  }
  EXPECT_NEAR(TurnByFall(world, kBlock, Pose::Identity()), most, 0.01 * most);
}

}  // namespace
}  // namespace assay::uncertainty::tilting_test
