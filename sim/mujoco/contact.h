#pragma once

#include <vector>

#include "planner/geometry/coordinates.h"
#include "sim/mujoco/data.h"

namespace assay::mujoco {

// One contact point at the present time. Vectors are in the world frame, in metres and newtons.
struct Contact {
  GeomId geom_a;
  GeomId geom_b;
  BodyId body_a;
  BodyId body_b;
  geometry::Vector3 position = geometry::Vector3::Zero();
  geometry::Vector3 normal = geometry::Vector3::Zero();  // unit vector from a to b
  double distance = 0;                                   // negative: depth of penetration
  double friction = 0;                                   // coefficient of sliding friction
  // Valid only after Data::Forward and in Data::Step(see_forces). The force on a is the opposite.
  geometry::Vector3 force_on_b = geometry::Vector3::Zero();
};

// Returns all contacts at the present time.
std::vector<Contact> Contacts(const Data& data);

// Returns the contacts between two bodies, oriented so that body_a is `a`.
std::vector<Contact> ContactsBetween(const Data& data, BodyId a, BodyId b);

}  // namespace assay::mujoco
