#pragma once

#include <span>
#include <vector>

#include "planner/geometry/coordinates.h"

struct mjModel_;
struct mjData_;

namespace assay::mujoco {

// A box around each geom of a model, by which separations are bounded.
class GeomBounds {
 public:
  explicit GeomBounds(const mjModel_& model);

  // Returns a distance in metres that geoms of bodies of different groups surely keep from each
  // other, as far as they may collide. Returns 0 if they may touch, and infinity if there are none.
  // `groups` has the group of each body, in the order of the model. The bound is quickly computed
  // from boxes around the geoms, and is smaller than the distance.
  double LeastSeparation(const mjModel_& model, const mjData_& data,
                         std::span<const int> groups) const;

 private:
  // In the frame of the geom, metres. A plane has no box.
  struct Bound {
    int geom = 0;
    bool is_plane = false;
    geometry::Vector3 center = geometry::Vector3::Zero();
    geometry::Vector3 half_extents = geometry::Vector3::Zero();
  };

  std::vector<Bound> colliding_;
};

}  // namespace assay::mujoco
