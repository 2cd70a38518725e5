#include "planner/geometry/solids/connected_solids.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "planner/base/random.h"
#include "planner/geometry/box.h"
#include "planner/geometry/hull.h"

namespace assay::geometry::connected_solids_test {
namespace {

constexpr std::uint64_t kSeed = 21;
constexpr double kGrid = 0.01;  // metres

// A box with corners on a grid. It can be decided exactly what two such boxes share.
struct GridBox {
  std::array<int, 3> low, high;

  Box InMetres() const {
    return Box::FromCorners(kGrid * Vector3(low[0], low[1], low[2]),
                            kGrid * Vector3(high[0], high[1], high[2]));
  }
};

GridBox RandomGridBox(RandomStream& random) {
  GridBox box{};
  for (std::size_t i = 0; i < 3; ++i) {
    box.low[i] = random.Index(4);
    box.high[i] = box.low[i] + 1 + random.Index(2);
  }
  return box;
}

// Returns whether the boxes share a volume or a face: at most one axis along which they only touch.
bool ShareAFace(const GridBox& a, const GridBox& b) {
  int touching = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const int overlap = std::min(a.high[i], b.high[i]) - std::max(a.low[i], b.low[i]);
    if (overlap < 0) return false;
    if (overlap == 0) ++touching;
  }
  return touching <= 1;
}

// Spreads over the boxes until nothing changes.
int NaiveFirstApart(const std::vector<GridBox>& boxes) {
  std::vector<bool> reached(boxes.size());
  reached[0] = true;
  for (bool changes = true; changes;) {
    changes = false;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      for (std::size_t j = 0; j < boxes.size(); ++j) {
        if (!reached[i] || reached[j] || !ShareAFace(boxes[i], boxes[j])) continue;
        reached[j] = changes = true;
      }
    }
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (!reached[i]) return static_cast<int>(i);
  }
  return -1;
}

int FirstApartOf(const std::vector<GridBox>& boxes) {
  std::vector<Box> in_metres;
  for (const GridBox& box : boxes) in_metres.push_back(box.InMetres());
  return FirstApart(HullsOf(in_metres));
}

TEST(FirstApart, AgreesWithExactBoxesOnAGrid) {
  RandomStream random(kSeed, "connected boxes");
  int connected = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<GridBox> boxes;
    for (int i = 1 + random.Index(5); i > 0; --i) boxes.push_back(RandomGridBox(random));
    const int apart = NaiveFirstApart(boxes);
    ASSERT_EQ(FirstApartOf(boxes), apart) << "trial " << trial;
    if (apart < 0) ++connected;
  }
  EXPECT_GT(connected, 200);
  EXPECT_LT(connected, 1800);
}

TEST(FirstApart, EdgesAndCornersHoldNothing) {
  const GridBox box = {{0, 0, 0}, {1, 1, 1}};
  EXPECT_EQ(FirstApartOf({box, {{1, 0, 0}, {2, 1, 1}}}), -1);
  EXPECT_EQ(FirstApartOf({box, {{1, 1, 0}, {2, 2, 1}}}), 1);
  EXPECT_EQ(FirstApartOf({box, {{1, 1, 1}, {2, 2, 2}}}), 1);
  EXPECT_EQ(FirstApartOf({box}), -1);
}

}  // namespace
}  // namespace assay::geometry::connected_solids_test
