#pragma once

#include <span>

#include "planner/geometry/coordinates.h"

namespace assay::geometry {

struct ConvexHull;

double Volume(const ConvexHull& solid);  // cubic metres

// Mass, centre of mass and inertia of a union of convex solids.
struct MassProperties {
  double mass = 0;                    // kg
  Vector3 center = Vector3::Zero();   // centre of mass, in the frame of the solids
  Matrix3 inertia = Matrix3::Zero();  // about the centre, along the axes of the frame, kg m^2
};
// Returns the exact mass properties of a union of solids of one density, in kg/m^3. Overlaps count
// once.
MassProperties MassOf(std::span<const ConvexHull> solids, double density);

}  // namespace assay::geometry
