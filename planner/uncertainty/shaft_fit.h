#pragma once

#include <string>
#include <vector>

#include "planner/domain/part_model.h"
#include "planner/domain/problem.h"
#include "planner/geometry/polygon.h"

namespace assay::uncertainty {

using geometry::Pose;
using geometry::Vector3;

// By how much the product of two unit vectors may differ from -1, 0 or 1 where they count as
// opposite, perpendicular or equal.
inline constexpr double kParallel = 1e-6;

// A shaft that goes into a hole in a mating.
struct ShaftFit {
  const domain::PartModel& hole_model;
  const domain::Feature& hole;
  const domain::PartModel& shaft_model;
  const domain::Feature& shaft;
  Pose X_HoleShaft;    // of their parts, when mated
  bool shaft_is_held;  // else the hole is
  std::string name;    // "shaft of peg in hole of block"
  double depth;        // metres of the seated shaft's tip behind the mouth
};
std::vector<ShaftFit> FitsOf(const domain::Problem& problem, const domain::Mating& mating);

// A side of a hole: the shaft must stay where normal . p > offset, in the hole's part.
struct SideWall {
  Vector3 normal;
  double offset = 0;
};
// `narrowing`: of the clearance on each side, metres; negative: the hole is wider.
std::vector<SideWall> SideWalls(const ShaftFit& fit, double narrowing);

// The cross-section of the shaft: inside the planes of its sides and the outline of its tip.
// Corners in the axes of the feature's frame, at the tip.
geometry::Polygon CrossSection(const ShaftFit& fit);

// How far a seated shaft may be out of the middle of its hole, whatever holds it.
struct SeatPlay {
  double shift = 0;  // of the held part's origin, in any direction, metres
  double turn = 0;   // about any axis, radians
};
SeatPlay PlayInSeat(const domain::Problem& problem, const domain::Mating& mating, double widening);

}  // namespace assay::uncertainty
