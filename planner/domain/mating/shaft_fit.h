#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "planner/domain/part/part_model.h"
#include "planner/domain/problem/problem.h"
#include "planner/geometry/polygon.h"

namespace assay::domain {

// By how much the product of two unit vectors may differ from -1, 0 or 1 where they count as
// opposite, perpendicular or equal.
inline constexpr double kUnitProduct = 1e-6;

// A shaft that goes into a hole in a mating.
struct ShaftFit {
  const PartModel& hole_model;
  const Feature& hole;
  const PartModel& shaft_model;
  const Feature& shaft;
  Pose X_HoleShaft;    // of their parts, when mated
  bool shaft_is_held;  // else the hole is
  std::string name;    // "shaft of peg in hole of block"
  double depth;        // metres of the seated shaft's tip behind the mouth
};
std::vector<ShaftFit> FitsOf(const Problem& problem, const Mating& mating);

// A side of a hole: the shaft must stay where normal . p > offset, in the hole's part.
struct SideWall {
  Vector3 normal;
  double offset = 0;
};
// `narrowing`: of the clearance on each side, metres; negative: the hole is wider.
std::vector<SideWall> SideWalls(const ShaftFit& fit, double narrowing);

// Two walls that face each other: the shaft must stay where low < across . p < high.
struct Slot {
  Vector3 across;  // unit, in the hole's part
  double low = 0;
  double high = 0;
};
// One for each direction across which the hole has walls on both sides, the narrowest there.
std::vector<Slot> SlotsOf(const std::vector<SideWall>& walls);
// "shaft of peg in hole of block across (0, 1, 0)": the slot's direction is of the hole's part.
std::string NameOf(const ShaftFit& fit, const Slot& slot);
// Whether walls face each other in more than one direction, so that nothing can leave between them.
bool HoldAllAround(const std::vector<Slot>& slots);

// Whether some shaft of the mating is in a hole that holds it all around: what certificates of
// assemble are about.
bool HasShaftInHole(const Problem& problem, const Mating& mating);

// The cross-section of the shaft: inside the planes of its sides and the outline of its tip.
// Corners in the axes of the feature's frame, at the tip. Empty if the shaft has no face that looks
// along its axis.
geometry::Polygon CrossSection(const ShaftFit& fit);

// From where to where the seated shaft's section reaches along a direction of the hole's part.
struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  double width() const { return high - low; }
};
// `turn`: radians, by which the shaft is turned about its axis.
Extent ExtentOf(const ShaftFit& fit, const geometry::Polygon& section, const Vector3& along,
                double turn = 0);

// The gap between a seated shaft and the walls on both sides, across a direction of the hole's
// part; the least of all fits of the mating whose walls face each other there.
struct FitGap {
  Vector3 across;   // unit, in the fixed part
  double low = 0;   // metres, on the side against `across`
  double high = 0;  // on the other
};
std::vector<FitGap> GapsOf(const Problem& problem, const Mating& mating);

// Whether the held part, with the fixed part at rest, has all its shafts between the walls of their
// holes, and the holes about theirs, at this pose: at the tip and at the seat's mouth.
bool FitsInside(const std::vector<ShaftFit>& fits, const Pose& X_FixedHeld);

// How far a seated shaft may be out of the middle of its hole, whatever holds it.
struct SeatPlay {
  double shift = 0;  // of the held part's origin, in any direction, metres
  double turn = 0;   // about any axis, radians
};
SeatPlay PlayInSeat(const Problem& problem, const Mating& mating, double widening);

}  // namespace assay::domain
