#include "planner/uncertainty/shaft_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/algebra/interval_arithmetic.h"
#include "planner/base/check.h"

namespace assay::uncertainty {
namespace {

using algebra::kInfinity;
using domain::Feature;
using domain::Part;
using domain::PartModel;
using geometry::Polygon;
using geometry::Vector2;

constexpr double kWide = 1e3;  // metres: beyond every part
constexpr double kFarthestTurn = std::numbers::pi / 8;
constexpr double kTurnStep = 1e-4;  // radians

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

struct Extent {
  double low = kInfinity;
  double high = -kInfinity;

  double width() const { return high - low; }
};

// Of a shaft's section along a direction of the hole's part, turned about the shaft's axis.
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

// Two walls that face each other.
struct Slot {
  Vector3 across;
  double low = 0;
  double high = 0;
};

std::vector<Slot> SlotsOf(const std::vector<SideWall>& walls) {
  std::vector<Slot> slots;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    for (std::size_t j = i + 1; j < walls.size(); ++j) {
      if (walls[i].normal.dot(walls[j].normal) > kParallel - 1) continue;
      slots.push_back({walls[i].normal, walls[i].offset, -walls[j].offset});
    }
  }
  return slots;
}

struct FitPlay {
  double shift = 0;
  double turn = 0;
  double tilt = 0;
};

// The play of one fit; none if there is no shaft inside, or a side is open.
std::optional<FitPlay> PlayOf(const ShaftFit& fit, double widening) {
  const std::vector<Slot> slots = SlotsOf(SideWalls(fit, -widening));
  if (slots.size() < 2 || !(fit.depth > 0)) return std::nullopt;
  const Polygon section = CrossSection(fit);
  double lateral = 0;
  for (const Slot& slot : slots) {
    const Extent extent = ExtentOf(fit, section, slot.across, 0);
    lateral = std::max({lateral, extent.low - slot.low, slot.high - extent.high});
  }
  const auto fits = [&](double turn) {
    return std::ranges::all_of(slots, [&](const Slot& slot) {
      return ExtentOf(fit, section, slot.across, turn).width() <= slot.high - slot.low &&
             ExtentOf(fit, section, slot.across, -turn).width() <= slot.high - slot.low;
    });
  };
  double turn = kTurnStep;
  while (turn < kFarthestTurn && fits(turn)) turn += kTurnStep;
  if (turn >= kFarthestTurn) turn = std::numbers::pi;  // as good as round

  // Both ends of what is inside stay within the play.
  const double tilt = 2 * lateral / fit.depth;
  const Pose X_HeldFeature = fit.shaft_is_held ? fit.shaft.X_PartFeature
                                               : fit.X_HoleShaft.inverse() * fit.hole.X_PartFeature;
  const Vector3 to_origin = X_HeldFeature.inverse().translation();
  return FitPlay{.shift = std::numbers::sqrt2 * lateral + turn * to_origin.head<2>().norm() +
                          tilt * to_origin.norm(),
                 .turn = turn,
                 .tilt = tilt};
}

}  // namespace

std::vector<ShaftFit> FitsOf(const domain::Problem& problem, const domain::Mating& mating) {
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
  const Vector3 axis = fit.hole.X_PartFeature.linear().col(2);
  std::vector<SideWall> walls;
  for (const domain::Wall& wall : fit.hole.walls) {
    const domain::Face& face = fit.hole_model.faces()[wall.face.index()];
    if (std::abs(face.normal.dot(axis)) >= kParallel) continue;
    walls.push_back({face.normal, face.offset});
    if (wall.moves_with_clearance) walls.back().offset += narrowing;
  }
  return walls;
}

Polygon CrossSection(const ShaftFit& fit) {
  const PartModel& model = fit.shaft_model;
  const Feature& shaft = fit.shaft;
  const Pose X_FeaturePart = shaft.X_PartFeature.inverse();
  Polygon section;
  for (const domain::FaceId id : shaft.faces) {
    const domain::Face& face = model.faces()[id.index()];
    const Vector3 normal = X_FeaturePart.linear() * face.normal;
    if (normal.z() < 1 - kParallel) continue;
    std::vector<Vector2> points;
    for (const Polygon& patch : face.patches) {
      for (const Vector2& p : patch) {
        points.push_back((X_FeaturePart * face.X_PartFace * Vector3(p.x(), p.y(), 0)).head<2>());
      }
    }
    section = geometry::Hull2(points);
  }
  for (const domain::FaceId id : shaft.faces) {
    const domain::Face& face = model.faces()[id.index()];
    const Vector3 normal = X_FeaturePart.linear() * face.normal;
    if (std::abs(normal.z()) > kParallel) continue;
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

SeatPlay PlayInSeat(const domain::Problem& problem, const domain::Mating& mating, double widening) {
  std::optional<FitPlay> least;
  double turn = std::numbers::pi;
  for (const ShaftFit& fit : FitsOf(problem, mating)) {
    const auto play = PlayOf(fit, widening);
    if (!play) continue;
    turn = std::min(turn, play->turn);
    if (!least || play->shift < least->shift) least = play;
  }
  ASSAY_CHECK(least.has_value(), "nothing holds a seated part");
  return {least->shift, turn + least->tilt};
}

}  // namespace assay::uncertainty
