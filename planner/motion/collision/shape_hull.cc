#include "planner/motion/collision/shape_hull.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "planner/geometry/box.h"
#include "planner/geometry/hull.h"

namespace assay::motion {
namespace {

using geometry::Pose;
using geometry::RoundedHull;
using geometry::Vector3;
using kinematics::BoxShape;
using kinematics::CylinderShape;
using kinematics::HullShape;
using kinematics::SphereShape;

constexpr int kPrismSides = 16;

RoundedHull HullAroundShape(const BoxShape& box, const Pose& X_LinkBox) {
  return RoundedHull(geometry::HullOf(geometry::Box{X_LinkBox, box.size / 2}));
}

// Corners 2 i and 2 i + 1 are one above the other.
RoundedHull HullAroundShape(const CylinderShape& cylinder, const Pose& X_LinkCylinder) {
  const double radius = cylinder.radius / std::cos(std::numbers::pi / kPrismSides);
  std::vector<Vector3> corners;
  std::vector<std::vector<int>> loops;
  std::vector<int> bottom;
  std::vector<int> top;
  for (int i = 0; i < kPrismSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kPrismSides;
    for (const double z : {-cylinder.length / 2, cylinder.length / 2}) {
      corners.push_back(X_LinkCylinder *
                        Vector3(radius * std::cos(angle), radius * std::sin(angle), z));
    }
    const int next = (i + 1) % kPrismSides;
    loops.push_back({2 * i, 2 * next, 2 * next + 1, 2 * i + 1});
    bottom.insert(bottom.begin(), 2 * i);
    top.push_back(2 * i + 1);
  }
  loops.push_back(std::move(bottom));
  loops.push_back(std::move(top));
  return RoundedHull(geometry::HullWith(std::move(corners), std::move(loops)));
}

// The hull is the regular icosahedron: cyclic permutations of (0, +-1, +-golden ratio). Its faces
// are golden^2 / sqrt(3) from its centre.
RoundedHull HullAroundShape(const SphereShape& sphere, const Pose& X_LinkSphere) {
  constexpr double kGolden = std::numbers::phi;
  const double scale = sphere.radius * std::numbers::sqrt3 / (kGolden * kGolden);
  std::vector<Vector3> corners;
  for (const double one : {-scale, scale}) {
    for (const double golden : {-kGolden * scale, kGolden * scale}) {
      corners.push_back(X_LinkSphere * Vector3(0, one, golden));
      corners.push_back(X_LinkSphere * Vector3(golden, 0, one));
      corners.push_back(X_LinkSphere * Vector3(one, golden, 0));
    }
  }
  return RoundedHull(corners);
}

RoundedHull HullAroundShape(const HullShape& shape, const Pose& X_LinkShape) {
  return RoundedHull(Transformed(*shape.hull, X_LinkShape));
}

}  // namespace

RoundedHull HullAround(const kinematics::Shape& shape, const Pose& X_LinkShape) {
  return std::visit([&](const auto& kind) { return HullAroundShape(kind, X_LinkShape); }, shape);
}

std::vector<RoundedHull> HullsOf(std::span<const geometry::ConvexHull> solids,
                                 const Pose& X_LinkSolids) {
  std::vector<RoundedHull> hulls;
  for (const geometry::ConvexHull& solid : solids) {
    hulls.emplace_back(Transformed(solid, X_LinkSolids));
  }
  return hulls;
}

}  // namespace assay::motion
