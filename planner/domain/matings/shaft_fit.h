#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "planner/domain/parts/part_model.h"
#include "planner/domain/problem/problem.h"
#include "planner/geometry/coordinates.h"

namespace assay::domain {

// Two unit vectors count as opposite, perpendicular or equal if their product differs from -1, 0 or
// 1 by at most this.
inline constexpr double kUnitProduct = 1e-6;

// A shaft that goes into a hole in a mating.
struct ShaftFit {
  const PartModel& hole_model;
  const Feature& hole;
  const PartModel& shaft_model;
  const Feature& shaft;
  Pose X_HoleShaft;    // pose of the shaft's part in the hole's part, when mated
  bool shaft_is_held;  // true: the shaft's part is held; false: the hole's part is
  std::string name;    // "shaft of peg in hole of block"
  double depth;        // distance of the seated shaft's tip behind the mouth, metres
};
std::vector<ShaftFit> FitsOf(const Problem& problem, const Mating& mating);

// A side of a hole: the shaft must stay where normal . p > offset, in the frame of the hole's part.
struct SideWall {
  Vector3 normal;
  double offset = 0;
};
// Returns the side walls of the hole. `narrowing` is taken from the clearance on each side, in
// metres; a negative one widens the hole.
std::vector<SideWall> SideWalls(const ShaftFit& fit, double narrowing);

// Two walls that face each other: the shaft must stay where low < across . p < high.
struct Slot {
  Vector3 across;  // unit, in the hole's part
  double low = 0;
  double high = 0;
};
// Returns one slot for each direction across which the hole has walls on both sides: the narrowest
// one.
std::vector<Slot> SlotsOf(const std::vector<SideWall>& walls);
// Returns the name of a slot: "shaft of peg in hole of block across (0, 1, 0)". The direction is in
// the frame of the hole's part.
std::string NameOf(const ShaftFit& fit, const Slot& slot);
// Returns whether walls face each other in more than one direction, so nothing can leave between
// them.
bool HoldAllAround(const std::vector<Slot>& slots);

// Returns whether some shaft of the mating is in a hole that holds it all around. Certificates of
// assemble are about these shafts only.
bool HasShaftInHole(const Problem& problem, const Mating& mating);

// Returns the cross-section of the shaft: what is inside the planes of its sides and the outline of
// its tip. Corners are in the axes of the feature's frame, at the tip. The result is empty if the
// shaft has no face that looks along its axis.
geometry::Polygon CrossSection(const ShaftFit& fit);

// Returns the radius of the circle through the corners of a shaft's section if the section stands
// for a circle: it is a regular polygon with at least 16 corners about the shaft's axis. What is
// proved of this circle holds for every turn of the shaft about its axis.
std::optional<double> RadiusOfRound(const geometry::Polygon& section);

// The range of the seated shaft's section along a direction of the hole's part, in metres.
struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  double width() const { return high - low; }
};
// Returns the extent of a shaft that is turned about its axis by `turn` radians.
Extent ExtentOf(const ShaftFit& fit, const geometry::Polygon& section, const Vector3& along,
                double turn = 0);

// The gaps between a seated shaft and the walls on both sides, across one direction. They are the
// least of all fits of the mating whose walls face each other in that direction.
struct FitGap {
  Vector3 across;   // unit, in the fixed part
  double low = 0;   // metres, on the side against `across`
  double high = 0;  // metres, on the side along `across`
};
std::vector<FitGap> GapsOf(const Problem& problem, const Mating& mating);

// Returns whether, with the fixed part at rest and the held part at this pose, all shafts are
// between the walls of their holes: at the tip and at the seat's mouth.
bool FitsInside(const std::vector<ShaftFit>& fits, const Pose& X_FixedHeld);

// The distance and angle by which a seated shaft may be out of the middle of its hole, whatever
// holds it.
struct SeatPlay {
  double shift = 0;  // shift of the held part's origin, in any direction, metres
  double turn = 0;   // about any axis, radians
  double spin = 0;   // about the shaft's axis alone, radians
};
// `widening` is added to the clearance on each side, in metres.
SeatPlay PlayInSeat(const Problem& problem, const Mating& mating, double widening);

}  // namespace assay::domain
