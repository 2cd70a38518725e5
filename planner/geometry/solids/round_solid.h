#pragma once

#include <array>
#include <optional>

#include "planner/geometry/coordinates.h"

namespace assay::geometry {

// A cylinder, or a cone or its frustum. In the model of a part, a solid with regular polygons
// stands for it. The polygons touch its circles from outside.
struct RoundSolid {
  std::array<Vector3, 2> ends;    // the middles of the two circles
  std::array<double, 2> radii{};  // metres; one of them may be zero
  int sides = 0;                  // of each polygon
};

RoundSolid Transformed(const RoundSolid& solid, const Pose& X);

// Returns the point at which a round solid touches a plane in place of a side of its polygons. The
// solid with polygons touches the plane at `corner`, which is a point of that side. The plane has
// the outward normal `normal` (unit) there. The round solid itself touches the plane only along the
// middle of the side. Returns none if `corner` is on no such side.
std::optional<Vector3> TouchInPlaceOf(const Vector3& corner, const RoundSolid& solid,
                                      const Vector3& normal);

}  // namespace assay::geometry
