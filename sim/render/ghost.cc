#include "sim/render/ghost.h"

#include <algorithm>

#include "planner/geometry/polygon.h"

namespace assay::render {
namespace {

using geometry::Polygon;
using geometry::Vector2;

constexpr double kTouching = 1e-6;  // metres between patches that count as touching

// Returns where the corners of the face's patches lie on the line from `from` (0) to `to` (1),
// including both ends.
std::vector<double> Cuts(const domain::Face& face, const Vector2& from, const Vector2& to) {
  const Vector2 along = to - from;
  std::vector<double> cuts = {0, 1};
  for (const Polygon& patch : face.patches) {
    for (const Vector2& corner : patch) {
      const double at = (corner - from).dot(along) / along.squaredNorm();
      const double aside = (corner - from - at * along).norm();
      if (aside < kTouching && at > 0 && at < 1) cuts.push_back(at);
    }
  }
  std::ranges::sort(cuts);
  return cuts;
}

bool IsOnFace(const domain::Face& face, const Vector2& point) {
  return std::ranges::any_of(
      face.patches, [&](const Polygon& patch) { return geometry::Depth(patch, point) > 0; });
}

// Adds the pieces of a patch's edge that do not border another patch of the face.
void AddOpenParts(const domain::Face& face, const Vector2& from, const Vector2& to,
                  std::vector<Edge>& edges) {
  const Vector2 along = to - from;
  const Vector2 outward = Vector2(along.y(), -along.x()).normalized();
  const auto in_part = [&](const Vector2& p) -> Vector3 {
    return face.X_PartFace * Vector3(p.x(), p.y(), 0);
  };
  const std::vector<double> cuts = Cuts(face, from, to);
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    if ((cuts[i + 1] - cuts[i]) * along.norm() < kTouching) continue;
    const Vector2 middle = from + (cuts[i] + cuts[i + 1]) / 2 * along;
    if (IsOnFace(face, middle + kTouching * outward)) continue;
    edges.push_back(
        {in_part(from + cuts[i] * along), in_part(from + cuts[i + 1] * along), face.normal});
  }
}

}  // namespace

std::vector<Edge> EdgesOf(const domain::PartModel& model) {
  std::vector<Edge> edges;
  for (const domain::Face& face : model.faces()) {
    for (const Polygon& patch : face.patches) {
      for (std::size_t i = 0; i < patch.size(); ++i) {
        AddOpenParts(face, patch[i], patch[(i + 1) % patch.size()], edges);
      }
    }
  }
  return edges;
}

Ghost GhostOf(const domain::PartModel& model, const Pose& X_WorldPart, Colour colour) {
  Ghost ghost{EdgesOf(model), colour};
  for (Edge& edge : ghost.edges) {
    edge = {X_WorldPart * edge.from, X_WorldPart * edge.to, X_WorldPart.linear() * edge.normal};
  }
  return ghost;
}

}  // namespace assay::render
