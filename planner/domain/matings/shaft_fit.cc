#include "planner/domain/matings/shaft_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "planner/base/check.h"
#include "planner/geometry/polygon.h"

namespace assay::domain {
namespace {

using geometry::Polygon;

constexpr double kWide = 1e3;  // metres, farther than any part reaches
constexpr double kFarthestTurn = std::numbers::pi / 8;
constexpr double kTurnLook = 1e-4;  // radians

bool IsHole(const Feature& feature) { return !feature.mouths.empty(); }
bool IsShaft(const Feature& feature) { return !IsHole(feature) && !feature.is_plain_face(); }

ShaftFit FitOf(const Part& shaft_part, const Feature& shaft, const Part& hole_part,
               const Feature& hole, const Pose& X_HoleShaft, bool shaft_is_held) {
  const Pose X_MouthTip = hole.X_PartFeature.inverse() * X_HoleShaft * shaft.X_PartFeature;
  return {.hole_model = *hole_part.model,
          .hole = hole,
          .shaft_model = *shaft_part.model,
          .shaft = shaft,
          .X_HoleShaft = X_HoleShaft,
          .shaft_is_held = shaft_is_held,
          .name = fmt::format("{} of {} in {} of {}", shaft.description, shaft_part.name,
                              hole.description, hole_part.name),
          .depth = std::max(0.0, -X_MouthTip.translation().z())};
}

// Returns a bound of the displacement of a shaft that may move by one metre across every slot. It
// is the distance of the corner between the two slots that are nearest to perpendicular. The same
// holds of a small tilt.
double FarthestIntoCorner(const std::vector<Slot>& slots) {
  double least = 1;
  for (const Slot& a : slots) {
    for (const Slot& b : slots) least = std::min(least, std::abs(a.across.dot(b.across)));
  }
  return std::sqrt(2 / (1 - least));
}

Extent Extended(Extent extent, const Polygon& outline, const Pose& X_PartFace,
                const Vector3& along) {
  for (const Vector2& corner : outline) {
    const double at = along.dot(X_PartFace * Vector3(corner.x(), corner.y(), 0));
    extent.low = std::min(extent.low, at);
    extent.high = std::max(extent.high, at);
  }
  return extent;
}

Extent Common(const Extent& a, const Extent& b) {
  return {.low = std::max(a.low, b.low), .high = std::min(a.high, b.high)};
}

// Returns the side wall for a wall that is along the hole's axis, or nothing for a floor.
std::optional<SideWall> SideOf(const ShaftFit& fit, const Wall& wall, double narrowing) {
  const Vector3 axis = fit.hole.X_PartFeature.linear().col(2);
  const Face& face = fit.hole_model.faces()[wall.face.index()];
  if (std::abs(face.normal.dot(axis)) >= kUnitProduct) return std::nullopt;
  return SideWall{face.normal, face.offset + (wall.moves_with_clearance ? narrowing : 0)};
}

bool Bounds(const SideWall& wall, const Slot& slot) {
  constexpr double kSamePlane = 1e-9;  // metres
  if (wall.normal.dot(slot.across) > 1 - kUnitProduct)
    return std::abs(wall.offset - slot.low) < kSamePlane;
  if (wall.normal.dot(slot.across) < kUnitProduct - 1)
    return std::abs(-wall.offset - slot.high) < kSamePlane;
  return false;
}

// Where a seated shaft and the walls of its hole face each other.
struct Engagement {
  double length = 0;             // metres along the hole's axis
  bool shaft_is_inside = false;  // both ends of the shaft are between the walls
};

// Returns where all walls of the slots and all sides of the shaft face each other. A shaft that
// goes through a thin plate is deeper in the hole than this, and a short pin may lie wholly inside.
Engagement EngagementOf(const ShaftFit& fit, const std::vector<Slot>& slots, double narrowing) {
  constexpr double kFlushEnds = 1e-9;  // metres
  const Vector3 axis = fit.hole.X_PartFeature.linear().col(2);
  std::map<FaceId, Extent> walls;  // a face may have several patches
  for (const Wall& wall : fit.hole.walls) {
    const std::optional<SideWall> side = SideOf(fit, wall, narrowing);
    if (!side) continue;
    if (!std::ranges::any_of(slots, [&](const Slot& slot) { return Bounds(*side, slot); }))
      continue;
    const Face& face = fit.hole_model.faces()[wall.face.index()];
    walls[wall.face] = Extended(walls[wall.face], wall.outline, face.X_PartFace, axis);
  }
  Extent hole = {.low = -kWide, .high = kWide};
  for (const auto& [face, extent] : walls) hole = Common(hole, extent);
  Extent shaft = {.low = -kWide, .high = kWide};
  for (const FaceId id : fit.shaft.faces) {
    const Face& face = fit.shaft_model.faces()[id.index()];
    if (std::abs((fit.X_HoleShaft.linear() * face.normal).dot(axis)) >= kUnitProduct) continue;
    Extent side;
    for (const Polygon& patch : face.patches)
      side = Extended(side, patch, fit.X_HoleShaft * face.X_PartFace, axis);
    shaft = Common(shaft, side);
  }
  return {
      .length = std::max(0.0, Common(hole, shaft).width()),
      .shaft_is_inside = hole.low < shaft.low + kFlushEnds && shaft.high < hole.high + kFlushEnds};
}

// Returns the greatest angle by which a shaft that is `width` wide can tilt in a slot that is
// `slot` wide.
//
// An edge of the slot touches a side of the shaft, and an end of the shaft or another edge touches
// on the other side. The two places are apart along the slot by the length of the engagement, less
// the height by which tilting raises one edge of the end. If the shaft is inside, its two ends may
// also touch the two sides of the slot.
double GreatestTilt(double width, double slot, const Engagement& engagement) {
  const double length = engagement.length;
  double by_ends = 0;
  if (engagement.shaft_is_inside) {
    const double diagonal = std::hypot(width, length);
    if (diagonal <= slot) return std::numbers::pi;
    by_ends = std::atan2(length, width) - std::acos(std::min(1.0, slot / diagonal));
  }
  constexpr double kTiltLook = 1e-4;  // radians
  for (double tilt = kTiltLook; tilt < std::numbers::pi / 2; tilt += kTiltLook) {
    const double apart = length - width * std::sin(tilt);
    if (slot * std::cos(tilt) - apart * std::sin(tilt) < width) return std::max(tilt, by_ends);
  }
  return std::numbers::pi;
}

struct FitPlay {
  double shift = 0;
  double turn = 0;
  double tilt = 0;
};

// Returns the play of one fit. Returns none if there is no shaft inside, or if a side is open.
std::optional<FitPlay> PlayOf(const ShaftFit& fit, double widening) {
  const std::vector<Slot> slots = SlotsOf(SideWalls(fit, -widening));
  if (!HoldAllAround(slots) || !(fit.depth > 0)) return std::nullopt;
  const Polygon section = CrossSection(fit);
  const Engagement engagement = EngagementOf(fit, slots, -widening);
  double lateral = 0;
  double tilt = 0;
  for (const Slot& slot : slots) {
    const Extent extent = ExtentOf(fit, section, slot.across);
    lateral = std::max({lateral, extent.low - slot.low, slot.high - extent.high});
    tilt = std::max(tilt, GreatestTilt(extent.width(), slot.high - slot.low, engagement));
  }
  tilt = std::min(std::numbers::pi, FarthestIntoCorner(slots) * tilt);
  const auto fits = [&](double turn) {
    return std::ranges::all_of(slots, [&](const Slot& slot) {
      return ExtentOf(fit, section, slot.across, turn).width() <= slot.high - slot.low &&
             ExtentOf(fit, section, slot.across, -turn).width() <= slot.high - slot.low;
    });
  };
  double turn = RadiusOfRound(section) ? kFarthestTurn : kTurnLook;
  while (turn < kFarthestTurn && fits(turn)) turn += kTurnLook;
  if (turn >= kFarthestTurn) turn = std::numbers::pi;  // a turn without limit, as of a round shaft

  const Pose X_HeldFeature = fit.shaft_is_held ? fit.shaft.X_PartFeature
                                               : fit.X_HoleShaft.inverse() * fit.hole.X_PartFeature;
  const Vector3 to_origin = X_HeldFeature.inverse().translation();
  return FitPlay{.shift = FarthestIntoCorner(slots) * lateral + turn * to_origin.head<2>().norm() +
                          tilt * to_origin.norm(),
                 .turn = turn,
                 .tilt = tilt};
}

bool AreParallel(const Vector3& a, const Vector3& b) {
  return std::abs(a.dot(b)) > 1 - kUnitProduct;
}

// Returns the gap that the fit leaves to the held part across a slot of the hole.
FitGap GapOf(const ShaftFit& fit, const Polygon& section, const Slot& slot) {
  const Extent extent = ExtentOf(fit, section, slot.across);
  const double low = extent.low - slot.low;
  const double high = slot.high - extent.high;
  if (fit.shaft_is_held) return {slot.across, low, high};
  return {fit.X_HoleShaft.linear().transpose() * slot.across, high, low};
}

void Narrow(std::vector<FitGap>& gaps, FitGap gap) {
  const auto known = std::ranges::find_if(
      gaps, [&](const FitGap& other) { return AreParallel(other.across, gap.across); });
  if (known == gaps.end()) {
    gaps.push_back(std::move(gap));
    return;
  }
  if (known->across.dot(gap.across) < 0) std::swap(gap.low, gap.high);
  known->low = std::min(known->low, gap.low);
  known->high = std::min(known->high, gap.high);
}

// Returns the polygon without corners that are within `tolerance` metres of the line through their
// neighbours, which clipping may leave.
Polygon WithoutStraightCorners(const Polygon& polygon, double tolerance) {
  Polygon corners;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2& before = corners.empty() ? polygon.back() : corners.back();
    const Vector2 along = (polygon[(i + 1) % polygon.size()] - before).normalized();
    const Vector2 to = polygon[i] - before;
    if (std::abs(along.x() * to.y() - along.y() * to.x()) > tolerance)
      corners.push_back(polygon[i]);
  }
  return corners;
}

}  // namespace

std::vector<ShaftFit> FitsOf(const Problem& problem, const Mating& mating) {
  const Part& held_part = problem.part(mating.held);
  const Part& fixed_part = problem.part(mating.fixed);
  std::vector<ShaftFit> fits;
  for (const auto& [of_held, of_fixed] : mating.features) {
    const Feature& held = *held_part.model->FindFeature(of_held);
    const Feature& fixed = *fixed_part.model->FindFeature(of_fixed);
    if (IsShaft(held) && IsHole(fixed)) {
      fits.push_back(FitOf(held_part, held, fixed_part, fixed, mating.X_FixedHeld, true));
    } else if (IsHole(held) && IsShaft(fixed)) {
      fits.push_back(
          FitOf(fixed_part, fixed, held_part, held, mating.X_FixedHeld.inverse(), false));
    }
  }
  return fits;
}

std::vector<SideWall> SideWalls(const ShaftFit& fit, double narrowing) {
  std::vector<SideWall> walls;
  for (const Wall& wall : fit.hole.walls) {
    if (const std::optional<SideWall> side = SideOf(fit, wall, narrowing)) walls.push_back(*side);
  }
  return walls;
}

std::vector<Slot> SlotsOf(const std::vector<SideWall>& walls) {
  std::vector<Slot> slots;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    for (std::size_t j = i + 1; j < walls.size(); ++j) {
      if (walls[i].normal.dot(walls[j].normal) > kUnitProduct - 1) continue;
      Slot slot = {walls[i].normal, walls[i].offset, -walls[j].offset};
      const auto known = std::ranges::find_if(
          slots, [&](const Slot& other) { return AreParallel(other.across, slot.across); });
      if (known == slots.end()) {
        slots.push_back(std::move(slot));
        continue;
      }
      if (known->across.dot(slot.across) < 0) slot = {-slot.across, -slot.high, -slot.low};
      known->low = std::max(known->low, slot.low);
      known->high = std::min(known->high, slot.high);
    }
  }
  return slots;
}

std::string NameOf(const ShaftFit& fit, const Slot& slot) {
  constexpr double kShown = 1e4;
  Vector3 across = (slot.across * kShown).array().round() / kShown;
  across.array() += 0.0;  // turns -0 into 0
  return fmt::format("{} across ({:.4g}, {:.4g}, {:.4g})", fit.name, across.x(), across.y(),
                     across.z());
}

bool HoldAllAround(const std::vector<Slot>& slots) { return slots.size() >= 2; }

bool HasShaftInHole(const Problem& problem, const Mating& mating) {
  return std::ranges::any_of(FitsOf(problem, mating), [](const ShaftFit& fit) {
    return HoldAllAround(SlotsOf(SideWalls(fit, 0)));
  });
}

Extent ExtentOf(const ShaftFit& fit, const Polygon& section, const Vector3& along, double turn) {
  Extent extent;
  for (const Vector2& corner : section) {
    const Vector2 turned = Eigen::Rotation2Dd(turn) * corner;
    const Vector3 p = fit.shaft.X_PartFeature * Vector3(turned.x(), turned.y(), 0);
    const double at = along.dot(fit.X_HoleShaft * p);
    extent.low = std::min(extent.low, at);
    extent.high = std::max(extent.high, at);
  }
  return extent;
}

std::vector<FitGap> GapsOf(const Problem& problem, const Mating& mating) {
  std::vector<FitGap> gaps;
  for (const ShaftFit& fit : FitsOf(problem, mating)) {
    const Polygon section = CrossSection(fit);
    for (const Slot& slot : SlotsOf(SideWalls(fit, 0))) Narrow(gaps, GapOf(fit, section, slot));
  }
  return gaps;
}

Polygon CrossSection(const ShaftFit& fit) {
  const PartModel& model = fit.shaft_model;
  const Feature& shaft = fit.shaft;
  const Pose X_FeaturePart = shaft.X_PartFeature.inverse();
  std::vector<Vector2> points;  // of the tip and of the bevels around it
  for (const FaceId id : shaft.faces) {
    const Face& face = model.faces()[id.index()];
    const Vector3 normal = X_FeaturePart.linear() * face.normal;
    if (normal.z() < kUnitProduct) continue;
    for (const Polygon& patch : face.patches) {
      for (const Vector2& p : patch) {
        points.push_back((X_FeaturePart * face.X_PartFace * Vector3(p.x(), p.y(), 0)).head<2>());
      }
    }
  }
  Polygon section = geometry::Hull2(points);
  for (const FaceId id : shaft.faces) {
    const Face& face = model.faces()[id.index()];
    const Vector3 normal = X_FeaturePart.linear() * face.normal;
    if (std::abs(normal.z()) > kUnitProduct) continue;
    const Vector2 n = normal.head<2>();
    const Vector2 along(-n.y(), n.x());
    const double offset = face.offset - face.normal.dot(shaft.X_PartFeature.translation());
    const Vector2 on = offset * n;
    section = geometry::Intersection(
        section, {on - kWide * along, on + kWide * along, on + kWide * along - kWide * n,
                  on - kWide * along - kWide * n});
  }
  return section;
}

std::optional<double> RadiusOfRound(const Polygon& section) {
  constexpr std::size_t kFewestCorners = 16;
  constexpr double kSame = 1e-7;  // metres
  const Polygon corners = WithoutStraightCorners(section, kSame);
  if (corners.size() < kFewestCorners) return std::nullopt;
  double radius = 0;
  for (const Vector2& corner : corners) radius = std::max(radius, corner.norm());
  const double side = (corners[1] - corners[0]).norm();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double next = (corners[(i + 1) % corners.size()] - corners[i]).norm();
    if (radius - corners[i].norm() > kSame || std::abs(next - side) > 2 * kSame) {
      return std::nullopt;
    }
  }
  return radius;
}

bool FitsInside(const std::vector<ShaftFit>& fits, const Pose& X_FixedHeld) {
  const auto is_inside = [&](const ShaftFit& fit) {
    const Pose X_HoleShaft = fit.shaft_is_held ? X_FixedHeld : X_FixedHeld.inverse();
    const std::vector<SideWall> walls = SideWalls(fit, 0);
    for (const Vector2& corner : CrossSection(fit)) {
      for (const double behind : {0.0, fit.depth}) {
        const Vector3 p =
            X_HoleShaft * fit.shaft.X_PartFeature * Vector3(corner.x(), corner.y(), -behind);
        const auto is_beyond = [&](const SideWall& wall) {
          return wall.normal.dot(p) < wall.offset;
        };
        if (std::ranges::any_of(walls, is_beyond)) return false;
      }
    }
    return true;
  };
  return std::ranges::all_of(fits, is_inside);
}

SeatPlay PlayInSeat(const Problem& problem, const Mating& mating, double widening) {
  std::optional<FitPlay> least;
  double turn = std::numbers::pi;
  for (const ShaftFit& fit : FitsOf(problem, mating)) {
    const auto play = PlayOf(fit, widening);
    if (!play) continue;
    turn = std::min(turn, play->turn);
    if (!least || play->shift < least->shift) least = play;
  }
  ASSAY_CHECK(least.has_value(), "nothing holds a seated part");
  return {.shift = least->shift, .turn = turn + least->tilt, .spin = turn};
}

}  // namespace assay::domain
