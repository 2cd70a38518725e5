#pragma once

#include <array>
#include <limits>
#include <vector>

#include "planner/domain/grasps/pad_room.h"
#include "planner/geometry/planar_region.h"

namespace assay::domain {

using geometry::Vector2;

constexpr double kEqualLength = 1e-7;  // lengths of grasps that differ less are equal, metres
// Margin around the pads beyond which more is no better, metres.
constexpr double kDeepEnough = 4e-3;

// Returns the extent of a polygon along a unit vector.
double ExtentOf(const geometry::Polygon& polygon, const Vector2& direction);

// Returns the least extent of a polygon, which is across one of its edges.
double BreadthOf(const geometry::Polygon& polygon);

// The region of a pair of faces on which pads can be: a convex outline without convex gaps.
class PadRegion {
 public:
  explicit PadRegion(const geometry::Patches& region);

  // Returns a point's distance from the border of the region; negative outside.
  double ClearanceAt(const Vector2& p) const;

  // Returns a pad's distance from the border of the region; negative if the pad sticks out. If the
  // distance is at most `floor`, the result is any number up to `floor`, which is found sooner.
  double MarginOf(const geometry::Polygon& pad,
                  double floor = std::numeric_limits<double>::lowest()) const;

  // Returns the room that a pad needs and has across the outline's edge at which most room is
  // missing. The pad sticks out by `overhang`. If the outline has room for the pad, the pad sticks
  // out into a gap.
  PadRoom Lacking(const geometry::Polygon& pad, double overhang) const;

  const geometry::Polygon& outline() const { return outline_; }  // hull of the region
  Eigen::AlignedBox2d Bounds() const;

 private:
  geometry::Polygon outline_;
  geometry::Patches gaps_;
};

// A candidate position of the pads' centres on a pair of faces.
struct Spot {
  Vector2 center;        // position in the middle plane
  double clearance = 0;  // distance to the border of the region
  // The distance to the centre of mass in that plane, x and y, as multiples of kEqualLength.
  std::array<long long, 3> order = {};
};

// Returns the positions inside the region on a grid through the region's centroid, and the position
// `first`. The nearest to the centre of mass come first.
std::vector<Spot> SpotsOf(const geometry::Patches& region, const PadRegion& room,
                          const Vector2& first, const Vector2& mass_center);

}  // namespace assay::domain
