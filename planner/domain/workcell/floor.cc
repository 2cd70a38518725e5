#include "planner/domain/workcell/floor.h"

#include <algorithm>
#include <cmath>

namespace assay::domain {
namespace {

using geometry::Vector3;

// Returns how far a shape reaches from its middle along a unit vector. `up` is that vector in the
// shape's own axes.
struct ReachOf {
  Vector3 up;

  double operator()(const kinematics::BoxShape& box) const {
    return up.cwiseAbs().dot(box.size) / 2;
  }
  double operator()(const kinematics::CylinderShape& cylinder) const {
    return std::abs(up.z()) * cylinder.length / 2 + up.head<2>().norm() * cylinder.radius;
  }
  double operator()(const kinematics::SphereShape& sphere) const { return sphere.radius; }
};

template <class Shapes>
double LowestOf(const Shapes& shapes, const geometry::Pose& X_WorldLink, double lowest) {
  for (const auto& placed : shapes) {
    const geometry::Pose X_WorldShape = X_WorldLink * placed.X_LinkShape;
    const Vector3 up = X_WorldShape.linear().transpose() * Vector3::UnitZ();
    const double reach = std::visit(ReachOf{up}, placed.shape);
    lowest = std::min(lowest, X_WorldShape.translation().z() - reach);
  }
  return lowest;
}

}  // namespace

double FloorHeight(const Workcell& workcell) {
  double floor = 0;
  for (const Table& table : workcell.tables()) floor = std::min(floor, -table.thickness);
  for (const Robot& robot : workcell.robots()) {
    const kinematics::Link& root = robot.arm->model().links.front();
    floor = root.collisions.empty() ? LowestOf(root.visuals, robot.X_WorldBase, floor)
                                    : LowestOf(root.collisions, robot.X_WorldBase, floor);
  }
  return floor;
}

}  // namespace assay::domain
