#include "planner/uncertainty/preconditions/touching_ahead.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>

#include "planner/domain/problem/problem_file.h"
#include "planner/geometry/polygon.h"
#include "tests/scratch_file.h"

namespace assay::uncertainty::touching_ahead_test {
namespace {

using geometry::Vector2;
using geometry::Vector3;

// A lid on a boss that is 0.1 mm higher than the plate around it, in millimetres.
const Vector2 kBoss{16, 16};
const Vector2 kPlate{60, 60};
const Vector2 kLid{48, 44};
constexpr double kStep = 0.1;

domain::Problem LidOnMushroom() {
  const std::filesystem::path models = ScratchFile("mushroom");
  const auto write = [&](const std::string& name, const std::string& rest) {
    std::filesystem::create_directories(models / "parts" / name);
    std::ofstream(models / "parts" / name / "part.yaml")
        << "format: assay-part/1\nname: " << name
        << "\nunits: {length: mm, angle: degree}\ndensity: 500\nfriction: 0.25\n"
        << rest;
  };
  write("mushroom", R"(initial: M
solids:
  foot: {box: [[-20, -20, 0], [20, 20, 30]]}
  plate: {box: [[-60, -60, 30], [60, 60, 40]]}
  boss: {box: [[-16, -16, 40], [16, 16, 40.1]]}
  post: {box: [[-6, -6, 40.1], [6, 6, 55]]}
features: {1: {shaft: post, axis: +z, what: post}}
stable_poses: {upright: -z}
)");
  write("lid", R"(initial: I
solids: {body: {box: [[-48, -44, 0], [48, 44, 46]]}}
pockets: {hole: {cut_from: body, box: [[-6, -6, 0], [6, 6, 20]], widen: [x, y]}}
features: {1: {hole: hole, axis: -z, what: hole}}
stable_poses: {flat: -z, on-edge: -y}
)");
  domain::ModelPath path;
  path.Append(models);
  path.Append(ASSAY_SOURCE_DIR "/models");
  return domain::ReadProblem(Document::Parse(R"(format: assay-scenario/1
units: {length: mm, angle: degree}
workcell: puma762-table
clearance: 1.5
parts:
  mushroom: {model: mushroom, pose: {stable: upright, at: [600, 150]}}
  lid: {model: lid, pose: {stable: on-edge, at: [520, -200]}}
goal:
  - assembled:
      held: lid
      fixed: mushroom
      features: [[1], [1]]
      pose: {columns: [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 40.1]]}
      mating_vector: [0, 0, -40]
)",
                                             "lid.yaml"),
                             path);
}

bool Within(const Vector2& p, const Vector2& half) {
  return std::abs(p.x()) <= half.x() && std::abs(p.y()) <= half.y();
}

// Returns the point of the mushroom, in millimetres, that a lid touches first whose underside
// slopes like this and is displaced. All corners of the overlaps are tried: one of them is first.
Vector2 FirstTouch(const Vector2& slope, const Vector2& displaced) {
  double nearest = std::numeric_limits<double>::infinity();
  Vector2 first = Vector2::Zero();
  for (const auto& [half, below] : {std::pair{kBoss, 0.0}, std::pair{kPlate, kStep}}) {
    const Vector2 low = (-kLid + displaced).cwiseMax(-half);
    const Vector2 high = (kLid + displaced).cwiseMin(half);
    for (const Vector2& p : {low, high, Vector2(low.x(), high.y()), Vector2(high.x(), low.y())}) {
      const double gap = slope.dot(p - displaced) + below;
      if (gap < nearest) {
        nearest = gap;
        first = p;
      }
    }
  }
  return first;
}

// Leaning lids touch the plate first within the hull of these points, or touch the boss first. Lids
// that lean too little for the plate have no such points.
TEST(FirstTouches, ContainWhatALeaningPartTouchesFirst) {
  const domain::Problem problem = LidOnMushroom();
  const domain::Mating& mating = problem.mating(domain::MatingId(0));
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(0, 1);
  const double off = 1.5;  // millimetres
  int on_plate = 0;
  for (const double lean : {1e-4, 5e-4, 2e-3, 0.01, 0.05}) {
    std::vector<Vector2> touches;
    for (const Vector3& p : FirstTouches(problem, mating, lean, 1e-3 * off))
      touches.emplace_back(1e3 * p.head<2>());
    const geometry::Polygon hull = geometry::Hull2(touches);
    for (int i = 0; i < 2000; ++i) {
      const auto towards = [&](double length) -> Vector2 {
        const double angle = 2 * std::numbers::pi * share(random);
        return length * Vector2(std::cos(angle), std::sin(angle));
      };
      const Vector2 first = FirstTouch(towards(lean * share(random)), towards(off * share(random)));
      if (Within(first, kBoss)) continue;
      ++on_plate;
      ASSERT_GE(geometry::Depth(hull, first), -1e-6) << lean << ": " << first.transpose();
    }
  }
  EXPECT_GT(on_plate, 1000);
  EXPECT_TRUE(FirstTouches(problem, mating, 1e-4, 1e-3 * off).empty());
}

}  // namespace
}  // namespace assay::uncertainty::touching_ahead_test
