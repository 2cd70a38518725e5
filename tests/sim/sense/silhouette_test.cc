#include "sim/sense/fitting/silhouette.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/base/random.h"
#include "planner/geometry/box.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/solids/convex_cut.h"
#include "planner/geometry/solids/mass_properties.h"
#include "tests/oracle/convex_solid.h"
#include "tests/sim/scene/peg_and_block.h"

namespace assay::sense::silhouette_test {
namespace {

using geometry::Box;
using geometry::ConvexHull;

constexpr int kSize = 300;

// Returns the point on a pixel's ray at one metre from the eye.
Vector3 OnRay(const View& view, const Vector2& pixel) {
  const double focal = kSize / 2.0 / std::tan(view.camera().vertical_angle / 2);
  const Vector3 in_camera(pixel.x() - kSize / 2.0, kSize / 2.0 - pixel.y(), -focal);
  return view.camera().X_WorldCamera * Vector3(in_camera.normalized());
}

bool HitsAny(const View& view, const Vector2& pixel, const std::vector<ConvexHull>& solids) {
  const Vector3 eye = view.camera().X_WorldCamera.translation();
  const Vector3 through = OnRay(view, pixel);
  return std::ranges::any_of(
      solids, [&](const ConvexHull& solid) { return oracle::RayHits(eye, through, solid); });
}

// A part in one of its stable poses, with a view from above.
struct Sight {
  std::vector<ConvexHull> solids;
  View view;
};

Sight RandomSight(const std::string& model, RandomStream& random) {
  const domain::Part part = scene::PartAt({.model = model, .stable_pose = "on-side"}, 0.0005);
  const auto& poses = part.model->stable_poses();
  const Pose& X_TablePart = poses[random.Index(static_cast<int>(poses.size()))].X_TablePart;
  const Pose X_WorldPart =
      domain::Placement{0.7, 0.1, random.Uniform(-3, 3)}.X_WorldTable() * X_TablePart;
  const Vector3 eye(random.Uniform(0, 1.5), random.Uniform(-1, 1), random.Uniform(1, 2));
  const Vector3 center = X_WorldPart * part.model->mass().center;
  return {geometry::Transformed(part.model->pieces(), X_WorldPart), View(eye, center, 0.13, kSize)};
}

class SilhouetteTest : public testing::TestWithParam<const char*> {
 protected:
  RandomStream random_{1, "silhouette"};
};

TEST_P(SilhouetteTest, ShadowsCoverWhatRaysHit) {
  for (int i = 0; i < 10; ++i) {
    const Sight sight = RandomSight(GetParam(), random_);
    const auto shadows = Shadows(sight.solids, sight.view);
    for (int pixel = 0; pixel < 400; ++pixel) {
      const Vector2 p(random_.Uniform(0, kSize), random_.Uniform(0, kSize));
      const bool covered = std::ranges::any_of(
          shadows, [&](const auto& shadow) { return geometry::Depth(shadow, p) > 0; });
      EXPECT_EQ(covered, HitsAny(sight.view, p, sight.solids)) << p.transpose();
    }
  }
}

TEST_P(SilhouetteTest, ContourPointsAreWhereTheHitsEnd) {
  for (int i = 0; i < 10; ++i) {
    const Sight sight = RandomSight(GetParam(), random_);
    const auto contour = Contour(sight.solids, sight.view, 3);
    ASSERT_GT(contour.size(), 50u);
    for (const ContourPoint& point : contour) {
      EXPECT_NEAR((sight.view.Project(point.p_World) - point.pixel).norm(), 0, 1e-9);
      EXPECT_NEAR(point.normal.norm(), 1, 1e-12);
      for (const double offset : {0.02, 1.0, 2.0}) {
        const Vector2 outside = point.pixel + offset * point.normal;
        EXPECT_FALSE(HitsAny(sight.view, outside, sight.solids)) << offset;
      }
      EXPECT_TRUE(HitsAny(sight.view, point.pixel - 0.01 * point.normal, sight.solids));
    }
  }
}

bool AnyWithin(double distance, const std::vector<Vector2>& pixels, const Vector2& p) {
  return std::ranges::any_of(pixels, [&](const Vector2& q) { return (q - p).norm() < distance; });
}

// Wherever hits end along a row of pixels, a contour point must be near. Ends near a corner do not
// count. A few are missed where the outlines of two boxes cross.
TEST_P(SilhouetteTest, TheContourHasNoGaps) {
  int ends = 0;
  int missed = 0;
  for (int i = 0; i < 5; ++i) {
    const Sight sight = RandomSight(GetParam(), random_);
    std::vector<Vector2> contour;
    std::vector<Vector2> corners;
    for (const auto& point : Contour(sight.solids, sight.view, 3)) contour.push_back(point.pixel);
    for (const auto& shadow : Shadows(sight.solids, sight.view)) {
      corners.insert(corners.end(), shadow.begin(), shadow.end());
    }
    for (int row = 0; row < kSize; row += 7) {
      for (int column = 0; column + 1 < kSize; ++column) {
        const Vector2 p(column + 0.5, row + 0.5);
        const bool ends_here = HitsAny(sight.view, p, sight.solids) !=
                               HitsAny(sight.view, p + Vector2(1, 0), sight.solids);
        if (!ends_here || AnyWithin(8, corners, p)) continue;
        ++ends;
        if (!AnyWithin(4, contour, p)) ++missed;
      }
    }
  }
  EXPECT_GT(ends, 50);
  EXPECT_LE(missed, 0.05 * ends);
}

INSTANTIATE_TEST_SUITE_P(Parts, SilhouetteTest,
                         testing::Values("block", "peg", "keyed-peg", "brick"),
                         [](const auto& instance) {
                           std::string name = instance.param;
                           std::erase(name, '-');
                           return name;
                         });

// The boxes form a ring, seen from straight above. The contour goes around its hole as well.
TEST(Silhouette, GoesAroundThroughHoles) {
  const Box plate = Box::FromCorners({-0.05, -0.05, 0}, {0.05, 0.05, 0.02});
  const Box hole = Box::FromCorners({-0.02, -0.02, -0.01}, {0.02, 0.02, 0.03});
  const View above({0, 0, 1}, {0, 0, 0}, 0.1, kSize);
  const auto contour = Contour(Without(HullOf(plate), HullOf(hole)), above, 3);
  const auto inner = std::ranges::count_if(contour, [](const ContourPoint& point) {
    return point.p_World.head<2>().cwiseAbs().maxCoeff() < 0.021;
  });
  EXPECT_GT(inner, 40);
  for (const ContourPoint& point : contour) {
    const bool is_inner = point.p_World.head<2>().cwiseAbs().maxCoeff() < 0.021;
    const Vector2 from_middle = point.pixel - Vector2(kSize, kSize) / 2;
    EXPECT_EQ(point.normal.dot(from_middle) < 0, is_inner);
  }
}

}  // namespace
}  // namespace assay::sense::silhouette_test
