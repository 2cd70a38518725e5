#include "planner/domain/workcell/floor.h"

#include <algorithm>
#include <cmath>

#include "planner/geometry/hull.h"

namespace assay::domain {
namespace {

using geometry::Vector3;

// Returns how far a shape reaches downwards from its origin. `up` is the unit vector that points
// up, in the shape's own axes.
struct ReachOf {
  Vector3 up;

  double operator()(const kinematics::BoxShape& box) const {
    return up.cwiseAbs().dot(box.size) / 2;
  }
  double operator()(const kinematics::CylinderShape& cylinder) const {
    return std::abs(up.z()) * cylinder.length / 2 + up.head<2>().norm() * cylinder.radius;
  }
  double operator()(const kinematics::SphereShape& sphere) const { return sphere.radius; }
  double operator()(const kinematics::HullShape& shape) const {
    return geometry::GreatestAlong(*shape.hull, -up);
  }
};

template <class Shapes>
std::optional<double> LowestOf(const Shapes& shapes, const geometry::Pose& X_WorldLink) {
  std::optional<double> lowest;
  for (const auto& placed : shapes) {
    const geometry::Pose X_WorldShape = X_WorldLink * placed.X_LinkShape;
    const Vector3 up = X_WorldShape.linear().transpose() * Vector3::UnitZ();
    const double height = X_WorldShape.translation().z() - std::visit(ReachOf{up}, placed.shape);
    lowest = std::min(lowest.value_or(height), height);
  }
  return lowest;
}

}  // namespace

std::optional<double> UndersideOf(const kinematics::Link& link, const geometry::Pose& X_WorldLink) {
  return link.collisions.empty() ? LowestOf(link.visuals, X_WorldLink)
                                 : LowestOf(link.collisions, X_WorldLink);
}

double FloorHeight(const Workcell& workcell) {
  double floor = 0;
  for (const Table& table : workcell.tables()) floor = std::min(floor, -table.thickness);
  for (const Robot& robot : workcell.robots()) {
    const kinematics::Link& root = robot.arm->model().links.front();
    floor = std::min(floor, UndersideOf(root, robot.X_WorldBase).value_or(floor));
  }
  return floor;
}

}  // namespace assay::domain
