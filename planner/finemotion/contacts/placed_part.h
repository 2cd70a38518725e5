#pragma once

#include <vector>

#include "planner/finemotion/contacts/tolerated_part.h"

namespace assay::finemotion {

// An edge of a part at a pose.
struct PlacedEdge {
  Vector3 start;
  Vector3 direction;
  Extent extent;
};

// A part at a pose, in the stationary part's axes.
struct Placed {
  const ToleratedPart& part;
  Pose X;
  std::vector<PlacedEdge> edges;

  Placed(const ToleratedPart& placed_part, const Pose& X_StationaryPart)
      : part(placed_part), X(X_StationaryPart) {
    edges.reserve(part.edges.size());
    for (const ToleratedPart::Edge& edge : part.edges) {
      const Vector3 start = X * edge.start;
      const Vector3 direction = Turned(edge.direction);
      edges.push_back(
          {start, direction,
           edge.is_round ? Extent() : Extent::Of(start, start + edge.length * direction)});
    }
  }

  Vector3 Turned(const Vector3& v) const { return X.linear() * v; }
  Vector3 TurnedBack(const Vector3& v) const { return X.linear().transpose() * v; }
  Vector3 MovedBack(const Vector3& p) const { return TurnedBack(p - X.translation()); }
};

// Calls use(i, j) for each pair of an edge of the moving part and an edge of the stationary one
// whose boxes are within `reach` metres of each other.
template <class Use>
void ForNearEdges(const Placed& moving, const Placed& stationary, double reach, const Use& use) {
  for (std::size_t i = 0; i < moving.edges.size(); ++i) {
    const Extent& extent = moving.edges[i].extent;
    if (!stationary.part.extent.IsNear(extent, reach)) continue;
    for (std::size_t j = 0; j < stationary.edges.size(); ++j) {
      if (stationary.edges[j].extent.IsNear(extent, reach)) use(i, j);
    }
  }
}

}  // namespace assay::finemotion
