#include "sim/scene/supporting_solids.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "planner/geometry/box.h"
#include "planner/geometry/hull.h"

namespace assay::scene {
namespace {

using geometry::Box;
using geometry::ConvexHull;
using geometry::Vector3;

constexpr double kTolerance = 1e-9;  // metres for positions, relative for axes

bool InHull(const ConvexHull& hull, const Box& box) {
  const auto corners = box.Corners();
  return std::ranges::all_of(hull.facets, [&](const geometry::Facet& facet) {
    return std::ranges::all_of(corners, [&](const Vector3& corner) {
      return facet.normal.dot(corner) <= facet.offset + kTolerance;
    });
  });
}

bool ShareAxes(const Box& a, const Box& b) {
  return a.X_FrameBox.linear().isApprox(b.X_FrameBox.linear(), kTolerance);
}

// Returns the box with a's axes around both boxes.
Box Around(const Box& a, const Box& b) {
  const Vector3 center_b = a.X_FrameBox.inverse() * b.X_FrameBox.translation();
  const Vector3 low = (-a.half_extents).cwiseMin(center_b - b.half_extents);
  const Vector3 high = a.half_extents.cwiseMax(center_b + b.half_extents);
  return Box::FromCorners(low, high).Transformed(a.X_FrameBox);
}

// The first pair of boxes that a single box inside the hull can replace.
struct Merger {
  std::size_t first = 0;
  std::size_t second = 0;
  Box around;
};

std::optional<Merger> FindMerger(const std::vector<Box>& boxes, const ConvexHull& hull) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = i + 1; j < boxes.size(); ++j) {
      if (!ShareAxes(boxes[i], boxes[j])) continue;
      const Box around = Around(boxes[i], boxes[j]);
      if (InHull(hull, around)) return Merger{i, j, around};
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<ConvexHull> SupportingSolids(std::span<const ConvexHull> pieces,
                                         const ConvexHull& hull) {
  std::vector<Box> boxes;
  for (const ConvexHull& piece : pieces) {
    const std::optional<Box> box = AsBox(piece);
    if (!box) return {hull};
    boxes.push_back(*box);
  }
  while (const std::optional<Merger> merger = FindMerger(boxes, hull)) {
    boxes[merger->first] = merger->around;
    boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(merger->second));
  }
  return geometry::HullsOf(boxes);
}

}  // namespace assay::scene
