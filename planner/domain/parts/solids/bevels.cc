#include "planner/domain/parts/solids/bevels.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/domain/parts/exposed_faces.h"
#include "planner/geometry/ring.h"
#include "planner/geometry/solids/shadow.h"

namespace assay::domain {
namespace {

using geometry::ConvexHull;
using geometry::Polygon;
using geometry::Vector2;
using geometry::Vector3;

constexpr double kAlongAxis = 1e-6;  // of unit vectors
constexpr double kBeside = 1e-7;     // metres

// Returns whether solids cover all of an edge from outside. `outward` is the normal of the side
// that ends in this edge.
bool IsCovered(const Vector3& a, const Vector3& b, const Vector3& outward, const Vector3& axis,
               std::span<const ConvexHull> solids) {
  constexpr int kSamples = 16;
  for (int i = 0; i < kSamples; ++i) {
    const Vector3 beside = a + (i + 0.5) / kSamples * (b - a) + kBeside * (outward - axis);
    const auto contains = [&](const ConvexHull& solid) { return Contains(solid, beside, 0); };
    if (std::ranges::none_of(solids, contains)) return false;
  }
  return true;
}

Polygon SectionAt(const ConvexHull& solid, const Pose& X_PartSection, double height) {
  return geometry::ShadowBetween(Transformed(solid, X_PartSection.inverse()), height, height);
}

}  // namespace

std::vector<geometry::Plane> BevelsAtEnd(const ConvexHull& solid,
                                         std::span<const ConvexHull> solids, const Vector3& axis,
                                         double end, double size) {
  std::vector<geometry::Plane> bevels;
  for (const Side& side : SidesOf(solid)) {
    if (std::abs(side.normal.dot(axis)) > kAlongAxis) continue;
    for (std::size_t i = 0; i < side.corners.size(); ++i) {
      const Vector3& a = side.corners[i];
      const Vector3& b = side.corners[(i + 1) % side.corners.size()];
      if (std::max(std::abs(axis.dot(a) - end), std::abs(axis.dot(b) - end)) > kRounding) continue;
      if (IsCovered(a, b, side.normal, axis, solids)) continue;
      bevels.push_back({(side.normal + axis) / std::numbers::sqrt2,
                        (side.offset + end - size) / std::numbers::sqrt2});
    }
  }
  return bevels;
}

std::vector<ConvexHull> BevelledMouth(std::span<const ConvexHull> pocket, const Vector3& axis,
                                      double mouth, double size) {
  const Pose X_PartSection = FrameAlong(mouth * axis, axis);
  std::vector<ConvexHull> bevelled;
  for (const ConvexHull& piece : pocket) {
    const Polygon at_mouth = SectionAt(piece, X_PartSection, -kBeside);
    const Polygon below = SectionAt(piece, X_PartSection, -size);
    if (at_mouth.size() < 3 || below.size() < 3) continue;
    std::vector<Vector3> corners;
    for (const Vector2& p : below)
      corners.emplace_back(X_PartSection * Vector3(p.x(), p.y(), -size));
    for (const Vector2& p : geometry::MovedOutward(at_mouth, size))
      corners.emplace_back(X_PartSection * Vector3(p.x(), p.y(), 0));
    bevelled.push_back(geometry::HullOf(corners));
  }
  return bevelled;
}

}  // namespace assay::domain
