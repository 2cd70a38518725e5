#include "planner/geometry/polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/base/random.h"

namespace assay::geometry::polygon_test {
namespace {

constexpr std::uint64_t kSeed = 21;
const Polygon kSquare = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};

Vector2 RandomPoint(RandomStream& random, double reach) {
  const double x = random.Uniform(-reach, reach);
  return {x, random.Uniform(-reach, reach)};
}

Polygon RandomPolygon(RandomStream& random, double reach) {
  const Vector2 middle = RandomPoint(random, reach);
  std::vector<Vector2> points;
  for (int i = 3 + random.Index(6); i > 0; --i) points.push_back(middle + RandomPoint(random, 1));
  return Hull2(points);
}

Polygon Moved(const Polygon& polygon, double angle, const Vector2& shift) {
  Polygon moved;
  for (const Vector2& p : polygon) moved.push_back(Eigen::Rotation2Dd(angle) * p + shift);
  return moved;
}

// Returns the distance of p from the segment between a and b.
double SegmentDistance(const Vector2& a, const Vector2& b, const Vector2& p) {
  const double length2 = (b - a).squaredNorm();
  const double t = length2 > 0 ? std::clamp((b - a).dot(p - a) / length2, 0.0, 1.0) : 0.0;
  return (a + t * (b - a) - p).norm();
}

// Computes the gap by brute force. For disjoint polygons it is the least distance of corners and
// edges. Otherwise it is the least way out along the normal of an edge.
double NaiveGap(const Polygon& a, const Polygon& b) {
  double way_out = std::numeric_limits<double>::infinity();
  double apart = way_out;
  for (const auto& [p, q] : {std::pair(a, b), std::pair(b, a)}) {
    for (size_t i = 0; i < p.size(); ++i) {
      const Vector2 from = p[i], to = p[(i + 1) % p.size()];
      double deepest = -std::numeric_limits<double>::infinity();
      for (const Vector2& corner : q) {
        const Vector2 edge = to - from, other = corner - from;
        deepest = std::max(deepest, (edge.x() * other.y() - edge.y() * other.x()) / edge.norm());
        apart = std::min(apart, SegmentDistance(from, to, corner));
      }
      way_out = std::min(way_out, deepest);
    }
  }
  return way_out > 0 ? -way_out : apart;
}

TEST(PolygonTest, HullHoldsAllPointsTurnsLeftAndUsesThemOnly) {
  RandomStream random(kSeed, "hull");
  for (int i = 0; i < 2000; ++i) {
    std::vector<Vector2> points;
    for (int k = 3 + random.Index(30); k > 0; --k) {
      // Small integers make many repeated and collinear points.
      points.emplace_back(random.Index(8), random.Index(8));
    }
    const Polygon hull = Hull2(points);
    for (size_t k = 0; k < hull.size(); ++k) {
      EXPECT_NE(std::ranges::find(points, hull[k]), points.end());
      if (hull.size() < 3) continue;
      const Vector2 u = hull[(k + 1) % hull.size()] - hull[k];
      const Vector2 v = hull[(k + 2) % hull.size()] - hull[(k + 1) % hull.size()];
      EXPECT_GT(u.x() * v.y() - u.y() * v.x(), 0);
    }
    for (const Vector2& p : points) EXPECT_GE(Depth(hull, p), -1e-12) << "draw " << i;
    std::ranges::reverse(points);
    EXPECT_EQ(Hull2(points), hull);
  }
}

TEST(PolygonTest, HullOfDegeneratePointsIsAPointOrASegment) {
  EXPECT_TRUE(Hull2({}).empty());
  EXPECT_EQ(Hull2(Polygon{{1, 2}, {1, 2}}), (Polygon{{1, 2}}));
  EXPECT_EQ(Hull2(Polygon{{2, 2}, {0, 0}, {1, 1}, {0, 0}}), (Polygon{{0, 0}, {2, 2}}));
}

TEST(PolygonTest, AreaAndCentroidOfKnownShapes) {
  EXPECT_DOUBLE_EQ(Area(kSquare), 4);
  EXPECT_TRUE(Centroid(kSquare).isApprox(Vector2(1, 1)));
  EXPECT_DOUBLE_EQ(Area({{0, 0}, {3, 0}, {0, 6}}), 9);
  EXPECT_TRUE(Centroid({{0, 0}, {3, 0}, {0, 6}}).isApprox(Vector2(1, 2)));
  Polygon hexagon;
  for (int i = 0; i < 6; ++i) {
    hexagon.emplace_back(std::cos(i * std::numbers::pi / 3), std::sin(i * std::numbers::pi / 3));
  }
  EXPECT_NEAR(Area(hexagon), 1.5 * std::sqrt(3), 1e-14);
  EXPECT_LT(Centroid(hexagon).norm(), 1e-14);
}

TEST(PolygonTest, AreaAndCentroidOfDegeneratePolygons) {
  EXPECT_EQ(Area(Polygon()), 0);
  EXPECT_EQ(Area({{1, 1}}), 0);
  EXPECT_EQ(Area({{1, 1}, {2, 5}}), 0);
  EXPECT_EQ(Centroid({{1, 1}}), Vector2(1, 1));
  EXPECT_EQ(Centroid({{1, 1}, {3, 5}}), Vector2(2, 3));
}

TEST(PolygonTest, AreaAndCentroidFollowRigidMotions) {
  RandomStream random(kSeed, "motion");
  for (int i = 0; i < 1000; ++i) {
    const Polygon polygon = RandomPolygon(random, 5);
    const double angle = random.Uniform(-3, 3);
    const Vector2 shift = RandomPoint(random, 100);
    const Polygon moved = Moved(polygon, angle, shift);
    EXPECT_NEAR(Area(moved), Area(polygon), 1e-11);
    EXPECT_LT((Centroid(moved) - (Eigen::Rotation2Dd(angle) * Centroid(polygon) + shift)).norm(),
              1e-9);
  }
}

TEST(PolygonTest, IntersectionOfSquares) {
  const Polygon corner = Intersection(kSquare, Moved(kSquare, 0, {1, 1}));
  EXPECT_DOUBLE_EQ(Area(corner), 1);
  EXPECT_TRUE(Centroid(corner).isApprox(Vector2(1.5, 1.5)));
  EXPECT_TRUE(Intersection(kSquare, Moved(kSquare, 0, {3, 0})).empty());
  EXPECT_TRUE(Intersection(kSquare, Moved(kSquare, 0, {2, 0})).empty()) << "a common edge";
  EXPECT_TRUE(Intersection(kSquare, Moved(kSquare, 0, {2, 2})).empty()) << "a common corner";
  EXPECT_TRUE(Intersection(kSquare, {}).empty());
  EXPECT_TRUE(Intersection({{0, 0}, {1, 1}}, kSquare).empty());
  EXPECT_EQ(Intersection(kSquare, kSquare), kSquare);
}

TEST(PolygonTest, IntersectionHoldsExactlyTheCommonPoints) {
  RandomStream random(kSeed, "intersection");
  for (int i = 0; i < 1000; ++i) {
    const Polygon a = RandomPolygon(random, 1), b = RandomPolygon(random, 1);
    const Polygon common = Intersection(a, b);
    EXPECT_NEAR(Area(common), Area(Intersection(b, a)), 1e-12);
    EXPECT_LE(Area(common), std::min(Area(a), Area(b)) + 1e-12);
    for (int k = 0; k < 30; ++k) {
      const Vector2 p = RandomPoint(random, 2);
      const double depth = std::min(Depth(a, p), Depth(b, p));
      if (std::abs(depth) < 1e-9) continue;
      EXPECT_EQ(Depth(common, p) > 0, depth > 0) << "draw " << i << " seed " << kSeed;
    }
  }
}

TEST(PolygonTest, DepthIsTheLeastDistanceToAnEdgesLine) {
  EXPECT_DOUBLE_EQ(Depth(kSquare, {1, 0.25}), 0.25);
  EXPECT_DOUBLE_EQ(Depth(kSquare, {2, 1}), 0);
  EXPECT_DOUBLE_EQ(Depth(kSquare, {3, 4}), -2);
  EXPECT_EQ(Depth({}, {0, 0}), -std::numeric_limits<double>::infinity());
  EXPECT_DOUBLE_EQ(Depth({{1, 1}}, {4, 5}), -5);
  EXPECT_DOUBLE_EQ(Depth({{0, 0}, {2, 0}}, {1, 3}), -3);
  EXPECT_DOUBLE_EQ(Depth({{0, 0}, {2, 0}}, {6, 3}), -5);
}

TEST(PolygonTest, InsetHoldsThePointsThatAreSoDeep) {
  RandomStream random(kSeed, "inset");
  for (int trial = 0; trial < 200; ++trial) {
    const Polygon polygon = RandomPolygon(random, 1);
    const double depth = random.Uniform(0, 0.4);
    const Polygon inset = Inset(polygon, depth);
    for (int i = 0; i < 50; ++i) {
      const Vector2 p = RandomPoint(random, 2);
      const double inside = Depth(polygon, p) - depth;
      if (std::abs(inside) < 1e-9) continue;
      EXPECT_EQ(!inset.empty() && Depth(inset, p) > 0, inside > 0);
    }
  }
  EXPECT_TRUE(Inset({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 0.6).empty());
}

TEST(PolygonTest, GapThatIsEnoughIsFoundSooner) {
  const Polygon apart = Moved(kSquare, 0.3, {5, 6});
  const double gap = Gap(kSquare, apart);
  for (const double enough : {0.0, 0.5 * gap, gap, 2 * gap}) {
    const double found = Gap(kSquare, apart, enough);
    EXPECT_LE(found, gap);
    EXPECT_EQ(std::min(found, enough), std::min(gap, enough));
  }
}

TEST(PolygonTest, GapOfKnownShapes) {
  EXPECT_DOUBLE_EQ(Gap(kSquare, Moved(kSquare, 0, {2.5, 1})), 0.5);
  EXPECT_DOUBLE_EQ(Gap(kSquare, Moved(kSquare, 0, {2, 1})), 0);
  EXPECT_DOUBLE_EQ(Gap(kSquare, Moved(kSquare, 0, {1.75, 1})), -0.25);
  EXPECT_DOUBLE_EQ(Gap(kSquare, Moved(kSquare, 0, {5, 6})), 5) << "corner to corner";
  EXPECT_DOUBLE_EQ(Gap(kSquare, kSquare), -2);
  EXPECT_DOUBLE_EQ(Gap({{0, 0}}, {{3, 4}}), 5);
  EXPECT_DOUBLE_EQ(Gap({{3, 4}}, {{3, 4}}), 0);
  EXPECT_DOUBLE_EQ(Gap({{0, 0}, {2, 0}}, {{4, 0}}), 2);
  EXPECT_DOUBLE_EQ(Gap(kSquare, {{1, 0.5}}), -0.5);
}

TEST(PolygonTest, GapIsSymmetricAndAgreesWithBruteForce) {
  RandomStream random(kSeed, "gap");
  int overlapping = 0;
  for (int i = 0; i < 10000; ++i) {
    const Polygon a = RandomPolygon(random, 1.5), b = RandomPolygon(random, 1.5);
    const double gap = Gap(a, b);
    EXPECT_DOUBLE_EQ(gap, Gap(b, a));
    EXPECT_NEAR(gap, NaiveGap(a, b), 1e-12) << "draw " << i << " seed " << kSeed;
    EXPECT_EQ(gap < 0, !Intersection(a, b).empty()) << "draw " << i << " seed " << kSeed;
    overlapping += int{gap < 0};
  }
  EXPECT_GT(overlapping, 1000);
  EXPECT_LT(overlapping, 9000);
}

// The radius of gyration of a rectangle is sqrt((a^2 + b^2) / 12). For two squares of side 2, whose
// centres are 6 apart, the parallel axis theorem adds the square of 3, the distance of each centre
// from the common one.
TEST(PolygonTest, RadiusOfGyration) {
  const Polygon rectangle = {{1, 1}, {4, 1}, {4, 5}, {1, 5}};
  EXPECT_NEAR(RadiusOfGyration(std::vector<Polygon>{rectangle}), std::sqrt((9.0 + 16.0) / 12),
              1e-12);
  const Polygon left = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  const Polygon right = Moved(left, 0, {6, 0});
  EXPECT_NEAR(RadiusOfGyration(std::vector<Polygon>{left, right}), std::sqrt(8.0 / 12 + 9), 1e-12);
  EXPECT_EQ(RadiusOfGyration(std::vector<Polygon>{{{0, 0}, {1, 0}}}), 0);
  EXPECT_EQ(RadiusOfGyration({}), 0);
}

}  // namespace
}  // namespace assay::geometry::polygon_test
