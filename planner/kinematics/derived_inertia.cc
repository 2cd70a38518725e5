#include "planner/kinematics/derived_inertia.h"

#include <array>
#include <numbers>
#include <variant>

#include "planner/geometry/hull.h"
#include "planner/geometry/solids/mass_properties.h"
#include "planner/kinematics/fixed_links.h"

namespace assay::kinematics {
namespace {

// Returns the inertia of a shape in its own frame.
struct InertialOfShape {
  Inertial operator()(const BoxShape& box) const {
    const Vector3 squared = box.size.cwiseAbs2();
    const double mass = kDerivedDensity * box.size.prod();
    return {.mass = mass,
            .inertia = (mass / 12 * (Vector3::Constant(squared.sum()) - squared)).asDiagonal()};
  }
  Inertial operator()(const CylinderShape& cylinder) const {
    const double squared = cylinder.radius * cylinder.radius;
    const double mass = kDerivedDensity * std::numbers::pi * squared * cylinder.length;
    const double across = mass * (squared / 4 + cylinder.length * cylinder.length / 12);
    return {.mass = mass, .inertia = Vector3(across, across, mass * squared / 2).asDiagonal()};
  }
  Inertial operator()(const SphereShape& sphere) const {
    const double squared = sphere.radius * sphere.radius;
    const double mass = kDerivedDensity * 4 / 3 * std::numbers::pi * squared * sphere.radius;
    return {.mass = mass, .inertia = 0.4 * mass * squared * Matrix3::Identity()};
  }
  Inertial operator()(const HullShape& shape) const {
    const std::array solids = {*shape.hull};
    const geometry::MassProperties of_hull = geometry::MassOf(solids, kDerivedDensity);
    return {.mass = of_hull.mass,
            .X_LinkCenter = Pose(Eigen::Translation3d(of_hull.center)),
            .inertia = of_hull.inertia};
  }
};

}  // namespace

std::optional<Inertial> DerivedInertial(const Link& link) {
  std::optional<Inertial> whole;
  for (const Collision& collision : link.collisions) {
    const Inertial inertial =
        Moved(collision.X_LinkShape, std::visit(InertialOfShape{}, collision.shape));
    whole = whole ? Joined(*whole, inertial) : inertial;
  }
  return whole;
}

}  // namespace assay::kinematics
