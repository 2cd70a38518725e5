#pragma once

#include <vector>

#include "planner/uncertainty/errors/uncertain_world.h"

namespace assay::uncertainty {

using geometry::Vector2;

// Where a part touches what it stands on: corners of a region, world.
struct Standing {
  PartId on;  // None: a table
  std::vector<Vector3> at;
};

// On what a part stands at X_WorldPart, without errors: on a table with its lowest vertices, and on
// other parts, where the plan has them now, with faces that look down. Parts in the hand carry
// nothing.
std::vector<Standing> StandingsOf(const UncertainWorld& world, PartId part,
                                  const Pose& X_WorldPart);

// An edge of what a part stands on, about which it could tip: outward . p == offset, in world x and
// y.
struct TippingEdge {
  Vector2 outward;  // unit
  double offset = 0;

  // How far p is beyond it, metres; negative: inside.
  double Beyond(const Vector3& p) const { return outward.dot(p.head<2>()) - offset; }
};
// None where the part stands on a line or a point.
std::vector<TippingEdge> TippingEdgesOf(const std::vector<Standing>& standings);

// What presses a part down, somewhere in the hull of these points, and may push it aside there.
struct Push {
  std::vector<Vector3> at;
  double down = 0;   // newtons
  double aside = 0;  // newtons, in any direction
};

// The moment by which pushes tip a part over that by which its weight
// keeps it, of the worst edge; and of all parts that it stands on. Below 1 it stays. Its fixture
// (domain::Part::clamp) clamps it. `off`: metres by which pushes may be elsewhere.
double TippingRatio(const UncertainWorld& world, PartId part, const std::vector<Push>& pushes,
                    double off);
// Likewise what pushes it aside over the friction that keeps it, the least within its tolerance.
double SlidingRatio(const domain::Problem& problem, PartId part, const std::vector<Push>& pushes);

}  // namespace assay::uncertainty
