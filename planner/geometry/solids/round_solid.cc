#include "planner/geometry/solids/round_solid.h"

#include <cmath>
#include <numbers>

namespace assay::geometry {
namespace {

constexpr double kRounding = 1e-6;  // metres and radians

}  // namespace

RoundSolid Transformed(const RoundSolid& solid, const Pose& X) {
  return {{X * solid.ends[0], X * solid.ends[1]}, solid.radii, solid.sides};
}

std::optional<Vector3> TouchInPlaceOf(const Vector3& corner, const RoundSolid& solid,
                                      const Vector3& normal) {
  const Vector3 along = solid.ends[1] - solid.ends[0];
  const Vector3 across = along.cross(normal) / along.norm();  // level, if the plane is the table
  const double steepness = across.norm();          // sine of the angle between axis and normal
  if (steepness < kRounding) return std::nullopt;  // the plane touches an end
  const double share = (corner - solid.ends[0]).dot(along) / along.squaredNorm();
  if (share * along.norm() < -kRounding || (share - 1) * along.norm() > kRounding) {
    return std::nullopt;
  }
  const Vector3 middle = solid.ends[0] + share * along;
  const double radius = solid.radii[0] + share * (solid.radii[1] - solid.radii[0]);
  const bool is_tangent = std::abs(normal.dot(middle - corner) + radius * steepness) <= kRounding;
  const double beside = across.dot(corner - middle) / steepness;
  const double half_side = radius * std::tan(std::numbers::pi / solid.sides);
  if (!is_tangent || std::abs(beside) > half_side + kRounding) return std::nullopt;
  return corner - beside * across / steepness;
}

}  // namespace assay::geometry
