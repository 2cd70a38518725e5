#include "planner/geometry/planar_region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "planner/base/random.h"
#include "planner/geometry/polygon.h"

namespace assay::geometry::planar_region_test {
namespace {

constexpr std::uint64_t kSeed = 5;

Polygon Rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

Polygon RandomPolygon(RandomStream& random) {
  std::vector<Vector2> points;
  for (int i = 0; i < 6; ++i) points.emplace_back(random.Uniform(-1, 1), random.Uniform(-1, 1));
  return Hull2(points);
}

int CountAround(const Patches& region, const Vector2& p) {
  return static_cast<int>(
      std::ranges::count_if(region, [&](const Polygon& q) { return Depth(q, p) > 0; }));
}

bool NearABorder(const Patches& region, const Vector2& p) {
  return std::ranges::any_of(region,
                             [&](const Polygon& q) { return std::abs(Depth(q, p)) < 1e-6; });
}

TEST(PlanarRegionTest, ASquareWithoutItsMiddleIsARing) {
  const Patches ring = Without({Rectangle(0, 0, 3, 3)}, Rectangle(1, 1, 2, 2));
  EXPECT_NEAR(Area(ring), 8, 1e-12);
  EXPECT_NEAR((Centroid(ring) - Vector2(1.5, 1.5)).norm(), 0, 1e-12);
  EXPECT_TRUE(Fills(ring, Rectangle(0, 0, 3, 1)));
  EXPECT_FALSE(Fills(ring, Rectangle(0, 0, 3, 1.01)));
  EXPECT_TRUE(Meets(ring, Rectangle(0.9, 1.2, 1.9, 1.8)));
  EXPECT_FALSE(Meets(ring, Rectangle(1, 1, 2, 2)));
  EXPECT_NEAR(Area(Hull(ring)), 9, 1e-12);
}

TEST(PlanarRegionTest, CutsThatOnlyTouchChangeNothing) {
  const Patches square = {Rectangle(0, 0, 1, 1)};
  EXPECT_EQ(Without(square, Rectangle(1, 0, 2, 1)), square);
  EXPECT_EQ(Without(square, Rectangle(1, 1, 2, 2)), square);
  EXPECT_EQ(Without(square, {}), square);
  EXPECT_TRUE(Without(square, Rectangle(-1, -1, 2, 2)).empty());
}

// Law: Area(A \ B) + Area(A and B) = Area(A). A point is in A \ B exactly if it is in A and not in
// B, and then it is in one patch only.
TEST(PlanarRegionTest, DifferenceAndIntersectionMakeUpTheWhole) {
  RandomStream random(kSeed, "difference");
  for (int trial = 0; trial < 300; ++trial) {
    const Polygon a = RandomPolygon(random);
    const Polygon b = RandomPolygon(random);
    const Polygon c = RandomPolygon(random);
    const Patches rest = Without(Without({a}, b), c);
    const Patches by_b = Common({a}, {b});
    EXPECT_NEAR(Area(Without({a}, b)) + Area(by_b), Area(a), 1e-9) << "trial " << trial;
    for (int i = 0; i < 50; ++i) {
      const Vector2 p(random.Uniform(-1, 1), random.Uniform(-1, 1));
      if (NearABorder({a, b, c}, p) || NearABorder(rest, p)) continue;
      const bool in = Depth(a, p) > 0 && Depth(b, p) < 0 && Depth(c, p) < 0;
      EXPECT_EQ(CountAround(rest, p), in ? 1 : 0) << "seed " << kSeed << " trial " << trial;
    }
  }
}

}  // namespace
}  // namespace assay::geometry::planar_region_test
