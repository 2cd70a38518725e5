#include "planner/geometry/solids/polygon_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/base/random.h"

namespace assay::geometry::polygon_pieces_test {
namespace {

constexpr std::uint64_t kSeed = 64;

// Returns a star-shaped polygon around a centre, mostly concave.
Ring RandomStar(RandomStream& random, const Vector2& center, double reach) {
  Ring ring;
  const int corners = 3 + random.Index(14);
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * (i + random.Uniform(0, 0.8)) / corners;
    ring.push_back(center +
                   random.Uniform(0.2, 1) * reach * Vector2(std::cos(angle), std::sin(angle)));
  }
  return ring;
}

double AreaOf(const Ring& ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector2& next = ring[(i + 1) % ring.size()];
    twice += ring[i].x() * next.y() - ring[i].y() * next.x();
  }
  return std::abs(twice) / 2;
}

bool IsConvex(const Polygon& polygon) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2 in = polygon[(i + 1) % polygon.size()] - polygon[i];
    const Vector2 out = polygon[(i + 2) % polygon.size()] - polygon[(i + 1) % polygon.size()];
    if (in.x() * out.y() - in.y() * out.x() < -1e-12) return false;
  }
  return true;
}

// The pieces are convex, their areas add up, and a point is in one of them exactly if it is inside
// the outline and in no hole.
TEST(ConvexPieces, AreExactlyThePolygonWithItsHoles) {
  RandomStream random(kSeed, "stars");
  int with_holes = 0;
  for (int trial = 0; trial < 500; ++trial) {
    Ring outline = RandomStar(random, Vector2::Zero(), 1);
    if (trial % 2 == 0) std::ranges::reverse(outline);
    std::vector<Ring> holes;
    for (int i = random.Index(3); i > 0; --i) {
      const Ring hole =
          RandomStar(random, {random.Uniform(-0.4, 0.4), random.Uniform(-0.4, 0.4)}, 0.15);
      const bool fits = IsInside(outline, hole.front()) && !SidesMeet(hole, outline) &&
                        std::ranges::none_of(holes, [&](const Ring& other) {
                          return SidesMeet(hole, other) || IsInside(other, hole.front()) ||
                                 IsInside(hole, other.front());
                        });
      if (fits) holes.push_back(hole);
    }
    with_holes += holes.empty() ? 0 : 1;
    const std::vector<Polygon> pieces = ConvexPieces(outline, holes);
    double area = 0;
    for (const Polygon& piece : pieces) {
      EXPECT_TRUE(IsConvex(piece)) << "seed " << kSeed << " trial " << trial;
      area += Area(piece);
    }
    double expected = AreaOf(outline);
    for (const Ring& hole : holes) expected -= AreaOf(hole);
    EXPECT_NEAR(area, expected, 1e-9) << "seed " << kSeed << " trial " << trial;
    for (int i = 0; i < 50; ++i) {
      const Vector2 p(random.Uniform(-1, 1), random.Uniform(-1, 1));
      const bool in_hole =
          std::ranges::any_of(holes, [&](const Ring& hole) { return IsInside(hole, p); });
      const auto depth = [&](const Polygon& piece) { return Depth(piece, p); };
      const double deepest = depth(*std::ranges::max_element(pieces, {}, depth));
      if (std::abs(deepest) < 1e-6) continue;
      EXPECT_EQ(deepest > 0, IsInside(outline, p) && !in_hole) << "seed " << kSeed;
    }
  }
  EXPECT_GT(with_holes, 100);
}

TEST(ConvexPieces, AConvexPolygonIsOnePiece) {
  Ring circle;
  for (int i = 0; i < 64; ++i) {
    circle.emplace_back(std::cos(i * std::numbers::pi / 32), std::sin(i * std::numbers::pi / 32));
  }
  EXPECT_EQ(ConvexPieces(circle, {}).size(), 1u);
}

// Returns a comb with many teeth, whose ears come in rows in both directions.
Ring Comb(int teeth) {
  Ring ring = {{0.0, -1.0}, {1.0 * teeth, -1.0}};
  for (int i = teeth; i > 0; --i) {
    ring.emplace_back(i, 1);
    ring.emplace_back(i - 0.5, 0);
  }
  return ring;
}

// Returns a band that winds around its middle.
Ring Spiral(int corners) {
  Ring ring;
  for (int i = 0; i < corners; ++i) {
    ring.push_back((2 + 0.02 * i) * Vector2(std::cos(0.1 * i), std::sin(0.1 * i)));
  }
  for (int i = corners; i-- > 0;) {
    ring.push_back((1.5 + 0.02 * i) * Vector2(std::cos(0.1 * i), std::sin(0.1 * i)));
  }
  return ring;
}

TEST(ConvexPieces, PolygonsWithManyConcaveCornersAreCutExactly) {
  for (const Ring& ring : {Comb(300), Spiral(500)}) {
    ASSERT_TRUE(IsSimple(ring));
    const std::vector<Polygon> pieces = ConvexPieces(ring, {});
    double area = 0;
    for (const Polygon& piece : pieces) {
      EXPECT_TRUE(IsConvex(piece));
      area += Area(piece);
    }
    EXPECT_NEAR(area, AreaOf(ring), 1e-9 * AreaOf(ring));
  }
}

TEST(ConvexPieces, TheFewestForAPlateWithAHole) {
  const Ring plate = {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}};
  const Ring hole = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  EXPECT_LE(ConvexPieces(plate, std::vector<Ring>{hole}).size(), 4u);
}

TEST(IsSimple, KnownAnswers) {
  EXPECT_TRUE(IsSimple({{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  EXPECT_TRUE(IsSimple({{0, 0}, {0, 1}, {1, 1}, {1, 0}}));
  EXPECT_FALSE(IsSimple({{0, 0}, {1, 1}, {1, 0}, {0, 1}})) << "a bow tie";
  EXPECT_FALSE(IsSimple({{0, 0}, {1, 0}})) << "a segment";
  EXPECT_FALSE(IsSimple({{0, 0}, {1, 0}, {1, 0}, {0, 1}})) << "a corner given twice";
  EXPECT_FALSE(IsSimple({{0, 0}, {2, 0}, {1, 0}, {1, 1}})) << "a side that folds back";
  EXPECT_FALSE(IsSimple({{0, 0}, {2, 0}, {2, 2}, {1, 0}, {0, 2}})) << "a corner on a side";
}

}  // namespace
}  // namespace assay::geometry::polygon_pieces_test
