#include "planner/motion/shape_hull.h"

#include <cmath>
#include <numbers>

namespace assay::motion {
namespace {

using geometry::Pose;
using geometry::RoundedHull;
using geometry::Vector3;
using kinematics::BoxShape;
using kinematics::CylinderShape;
using kinematics::SphereShape;

constexpr int kPrismSides = 16;

std::vector<Vector3> CornersAround(const BoxShape& box) {
  const auto corners = geometry::Box{Pose::Identity(), box.size / 2}.Corners();
  return {corners.begin(), corners.end()};
}

std::vector<Vector3> CornersAround(const CylinderShape& cylinder) {
  const double radius = cylinder.radius / std::cos(std::numbers::pi / kPrismSides);
  std::vector<Vector3> corners;
  for (int i = 0; i < kPrismSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kPrismSides;
    for (const double z : {-cylinder.length / 2, cylinder.length / 2}) {
      corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  }
  return corners;
}

// The regular icosahedron: cyclic permutations of (0, +-1, +-golden ratio), whose faces are
// golden^2 / sqrt(3) from its centre.
std::vector<Vector3> CornersAround(const SphereShape& sphere) {
  constexpr double kGolden = std::numbers::phi;
  const double scale = sphere.radius * std::numbers::sqrt3 / (kGolden * kGolden);
  std::vector<Vector3> corners;
  for (const double one : {-scale, scale}) {
    for (const double golden : {-kGolden * scale, kGolden * scale}) {
      corners.emplace_back(0, one, golden);
      corners.emplace_back(golden, 0, one);
      corners.emplace_back(one, golden, 0);
    }
  }
  return corners;
}

}  // namespace

RoundedHull HullAround(const kinematics::Shape& shape, const Pose& X_LinkShape) {
  std::vector<Vector3> corners =
      std::visit([](const auto& kind) { return CornersAround(kind); }, shape);
  for (Vector3& corner : corners) corner = X_LinkShape * corner;
  return RoundedHull(corners);
}

std::vector<RoundedHull> HullsOf(std::span<const geometry::Box> boxes, const Pose& X_LinkBoxes) {
  std::vector<RoundedHull> hulls;
  for (const geometry::Box& box : boxes) {
    hulls.emplace_back(box.Transformed(X_LinkBoxes).Corners());
  }
  return hulls;
}

}  // namespace assay::motion
