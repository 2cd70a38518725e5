#include "sim/sense/fitting/edge_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "planner/base/random.h"

namespace assay::sense::edge_search_test {
namespace {

constexpr int kSize = 64;
const Vector3 kPartColor(60, 100, 180);
const Vector3 kTableColor(210, 200, 180);
const Vector3 kHandColor(40, 40, 45);

// Returns a picture of surfaces that are a function of the place. The colour of a pixel is the mean
// of many samples, and its surface is that of most of them.
Picture PictureOf(const std::function<Surface(const Vector2&)>& surface_at) {
  constexpr int kSamples = 8;
  Picture picture{View({0, 0, 1}, {0, 0, 0}, 0.1, kSize), {kSize, kSize, {}}, {kSize, {}}};
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      Vector3 color = Vector3::Zero();
      int part = 0;
      Surface last = Surface::kElse;
      for (int i = 0; i < kSamples * kSamples; ++i) {
        last = surface_at(
            {column + (i % kSamples + 0.5) / kSamples, row + (i / kSamples + 0.5) / kSamples});
        if (last == Surface::kPart) ++part;
        color += last == Surface::kPart    ? kPartColor
                 : last == Surface::kTable ? kTableColor
                                           : kHandColor;
      }
      color /= kSamples * kSamples;
      for (const double c : color) {
        picture.image.rgb.push_back(static_cast<std::uint8_t>(std::lround(c)));
      }
      const bool mostly_part = 2 * part > kSamples * kSamples;
      picture.surfaces.surfaces.push_back(mostly_part              ? Surface::kPart
                                          : last == Surface::kPart ? Surface::kTable
                                                                   : last);
    }
  }
  return picture;
}

// A contour point near the picture's middle. The true edge of the part is `offset` pixels outward.
struct Edge {
  ContourPoint point;
  double offset = 0;

  double Outside(const Vector2& p) const { return (p - point.pixel).dot(point.normal) - offset; }
};

Edge EdgeAt(double angle, double offset) {
  return {.point = {.p_World = Vector3::Zero(),
                    .pixel = Vector2(kSize / 2.0 + 0.3, kSize / 2.0 - 0.2),
                    .normal = Vector2(std::cos(angle), std::sin(angle))},
          .offset = offset};
}

TEST(EdgeSearch, FindsTheEdgeToAFractionOfAPixel) {
  RandomStream random(1, "edges");
  for (int i = 0; i < 100; ++i) {
    const Edge edge = EdgeAt(random.Uniform(-3.2, 3.2), random.Uniform(-6, 6));
    const Picture picture = PictureOf(
        [&](const Vector2& p) { return edge.Outside(p) < 0 ? Surface::kPart : Surface::kTable; });
    const auto found = FindEdge(picture, edge.point, 8);
    ASSERT_TRUE(found);
    EXPECT_NEAR(*found, edge.offset, 0.1);
  }
}

TEST(EdgeSearch, FindsNothingBeyondItsRangeNorWhereTheTableBeginsInward) {
  const Edge far = EdgeAt(0.4, 6);
  EXPECT_FALSE(FindEdge(PictureOf([&](const Vector2& p) {
                          return far.Outside(p) < 0 ? Surface::kPart : Surface::kTable;
                        }),
                        far.point, 4));
  const Edge inward = EdgeAt(0.4, 0);
  EXPECT_FALSE(FindEdge(PictureOf([&](const Vector2& p) {
                          return inward.Outside(p) > 0 ? Surface::kPart : Surface::kTable;
                        }),
                        inward.point, 4));
}

// The hand is next to the edge and may hide the part there.
TEST(EdgeSearch, TakesNoEdgeOfWhatMayHideThePart) {
  const Edge edge = EdgeAt(1.1, 1);
  EXPECT_FALSE(FindEdge(PictureOf([&](const Vector2& p) {
                          return edge.Outside(p) < 0 ? Surface::kPart : Surface::kElse;
                        }),
                        edge.point, 8));
}

TEST(EdgeSearch, OfTwoEdgesTheNearer) {
  const Edge edge = EdgeAt(0.2, 1.5);
  const Picture picture = PictureOf([&](const Vector2& p) {
    const double outside = edge.Outside(p);
    return outside < 0 || (outside > 5 && outside < 10) ? Surface::kPart : Surface::kTable;
  });
  const auto found = FindEdge(picture, edge.point, 14);
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found, 1.5, 0.1);
}

}  // namespace
}  // namespace assay::sense::edge_search_test
