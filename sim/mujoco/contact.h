#pragma once

#include <vector>

#include "planner/geometry/pose.h"
#include "sim/mujoco/data.h"

namespace assay::mujoco {

// One contact point of the present, world frame, metres and newtons.
struct Contact {
  GeomId geom_a;
  GeomId geom_b;
  BodyId body_a;
  BodyId body_b;
  geometry::Vector3 position = geometry::Vector3::Zero();
  geometry::Vector3 normal = geometry::Vector3::Zero();  // unit, from a to b
  double distance = 0;                                   // negative: penetration
  double friction = 0;                                   // coefficient, of sliding
  // Right only after Data::Forward; a gets the opposite.
  geometry::Vector3 force_on_b = geometry::Vector3::Zero();
};

std::vector<Contact> Contacts(const Data& data);

// The contacts between two bodies, turned so that body_a is `a`.
std::vector<Contact> ContactsBetween(const Data& data, BodyId a, BodyId b);

}  // namespace assay::mujoco
