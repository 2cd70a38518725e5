#include "sim/mujoco/collision/geom_bounds.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <limits>

#include "sim/mujoco/collision/group_filter.h"

namespace assay::mujoco {
namespace {

using geometry::Matrix3;
using geometry::Vector3;
using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

// The half extent of a geom of a type that scenes do not have: it may touch everything.
constexpr double kEverywhere = 1e6;  // m

// The engine has vertices of meshes in single precision.
Eigen::AlignedBox3d BoundsOfMesh(const mjModel& m, int mesh) {
  Eigen::AlignedBox3d bounds;
  const float* const first = m.mesh_vert + 3 * m.mesh_vertadr[mesh];
  for (int i = 0; i < m.mesh_vertnum[mesh]; ++i) {
    bounds.extend(Vector3(first[3 * i], first[3 * i + 1], first[3 * i + 2]));
  }
  return bounds;
}

// Returns the half extents of the box around a geom that is symmetric about its origin.
Vector3 HalfExtentsOf(const mjModel& m, int geom) {
  const mjtNum* const size = m.geom_size + 3 * geom;
  switch (m.geom_type[geom]) {
    case mjGEOM_BOX:
    case mjGEOM_ELLIPSOID:
      return {size[0], size[1], size[2]};
    case mjGEOM_SPHERE:
      return {size[0], size[0], size[0]};
    case mjGEOM_CYLINDER:
      return {size[0], size[0], size[1]};
    case mjGEOM_CAPSULE:
      return {size[0], size[0], size[0] + size[1]};
    default:
      return Vector3::Constant(kEverywhere);
  }
}

// A box in the world. The columns of `axes` are its directions.
struct PlacedBox {
  Matrix3 axes;
  Vector3 center;
  Vector3 half_extents;
  double radius;

  // Returns how far the box reaches from its center along a unit vector.
  double Reach(const Vector3& direction) const {
    return (axes.transpose() * direction).cwiseAbs().dot(half_extents);
  }
};

// Returns the greatest gap between the boxes along the directions of their faces.
double Gap(const PlacedBox& a, const PlacedBox& b) {
  const Vector3 between = b.center - a.center;
  double gap = 0;
  for (const PlacedBox* box : {&a, &b}) {
    const PlacedBox& other = box == &a ? b : a;
    for (int i = 0; i < 3; ++i) {
      const Vector3 axis = box->axes.col(i);
      gap = std::max(gap, std::abs(between.dot(axis)) - box->half_extents[i] - other.Reach(axis));
    }
  }
  return gap;
}

// Returns whether the spheres around two boxes are apart by at least this length.
bool SpheresAreApart(const PlacedBox& a, const PlacedBox& b, double length) {
  const double sum = a.radius + b.radius + length;
  return (b.center - a.center).squaredNorm() >= sum * sum;
}

// The plane's points have z = 0 in its frame, and the box is to be on the side of positive z.
double GapOverPlane(const PlacedBox& plane, const PlacedBox& box) {
  const Vector3 up = plane.axes.col(2);
  return std::max(0.0, (box.center - plane.center).dot(up) - box.Reach(up));
}

}  // namespace

GeomBounds::GeomBounds(const mjModel& m) {
  for (int geom = 0; geom < m.ngeom; ++geom) {
    if (m.geom_contype[geom] == 0 && m.geom_conaffinity[geom] == 0) continue;
    Bound bound{.geom = geom, .is_plane = m.geom_type[geom] == mjGEOM_PLANE};
    if (m.geom_type[geom] == mjGEOM_MESH) {
      const Eigen::AlignedBox3d bounds = BoundsOfMesh(m, m.geom_dataid[geom]);
      bound.center = bounds.center();
      bound.half_extents = bounds.sizes() / 2;
    } else if (!bound.is_plane) {
      bound.half_extents = HalfExtentsOf(m, geom);
    }
    colliding_.push_back(bound);
  }
}

double GeomBounds::LeastSeparation(const mjModel& m, const mjData& d,
                                   std::span<const int> groups) const {
  std::vector<PlacedBox> boxes;
  boxes.reserve(colliding_.size());
  for (const Bound& bound : colliding_) {
    const Matrix3 axes = Eigen::Map<const RowMajor>(d.geom_xmat + 9 * bound.geom);
    const Eigen::Map<const Vector3> origin(d.geom_xpos + 3 * bound.geom);
    boxes.push_back(
        {axes, origin + axes * bound.center, bound.half_extents, bound.half_extents.norm()});
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const auto group = [&](std::size_t k) {
      return groups[static_cast<std::size_t>(m.geom_bodyid[colliding_[k].geom])];
    };
    for (std::size_t j = i + 1; j < boxes.size() && least > 0; ++j) {
      if (group(i) == group(j) || !BitsMatch(m, colliding_[i].geom, colliding_[j].geom)) continue;
      const bool i_is_plane = colliding_[i].is_plane;
      const bool j_is_plane = colliding_[j].is_plane;
      if (!i_is_plane && !j_is_plane && SpheresAreApart(boxes[i], boxes[j], least)) continue;
      least = std::min(least, i_is_plane   ? GapOverPlane(boxes[i], boxes[j])
                              : j_is_plane ? GapOverPlane(boxes[j], boxes[i])
                                           : Gap(boxes[i], boxes[j]));
    }
  }
  return least;
}

}  // namespace assay::mujoco
