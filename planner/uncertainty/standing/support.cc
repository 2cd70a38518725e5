#include "planner/uncertainty/standing/support.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "planner/domain/parts/part_model.h"
#include "planner/domain/resting/face_contact.h"
#include "planner/geometry/planar_region.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/solids/mass_properties.h"
#include "planner/uncertainty/error_sets/possible_masses.h"
#include "planner/uncertainty/preconditions/precondition.h"

namespace assay::uncertainty {
namespace {

using domain::PartModel;
using geometry::Polygon;

constexpr double kOnTheEdge = 1e-9;  // metres

// A force that acts down, and its moment about an edge.
struct Pressing {
  double down = 0;    // newtons
  double moment = 0;  // newton metres, positive beyond the edge
};

Pressing PressingOver(const TippingEdge& edge, double level, const std::vector<Push>& pushes,
                      double off) {
  Pressing pressing;
  for (const Push& push : pushes) {
    double farthest = 0;
    double highest = 0;
    for (const Vector3& p : push.at) {
      farthest = std::max(farthest, edge.Beyond(p) + off);
      highest = std::max(highest, p.z() - level);
    }
    pressing.down += push.down;
    pressing.moment += push.down * farthest + push.aside * highest;
  }
  return pressing;
}

// A bound of how far a part with this error at X_WorldPart is displaced against another part,
// compared with where the plan has both.
struct Displaced {
  double shift = 0;  // of the part's origin, metres
  double turn = 0;   // about the vertical through it, radians

  double At(const Vector2& from_origin) const { return shift + turn * from_origin.norm(); }
};

// A part in the hand will come to X_WorldPart with the believed pose of what it comes to.
Displaced DisplacedAgainst(const UncertainWorld& world, PartId part, const Pose& X_WorldPart,
                           const RestingError& error, PartId other) {
  const bool is_held = world.in_hand() == part;
  const RestingError its = is_held ? world.resting(other) : world.about_plan(other);
  const SymbolicVector arm =
      AsVector(X_WorldPart.translation() - world.X_WorldPart(other).translation());
  const SymbolicVector carried = its.displacement + algebra::RotationZ(its.theta) * arm - arm;
  const auto most = [&](const Expression& e) { return Magnitude(world.TightRangeOf(e)); };
  return {std::hypot(most(error.displacement[0] - carried[0]),
                     most(error.displacement[1] - carried[1])),
          most(error.theta - its.theta)};
}

// Returns the greatest distance by which a point of a contact is displaced.
double FarthestOf(const Displaced& displaced, const Standing& standing, const Pose& X_WorldPart) {
  double farthest = displaced.shift;
  for (const Vector3& p : standing.at)
    farthest = std::max(farthest, displaced.At((p - X_WorldPart.translation()).head<2>()));
  return farthest;
}

// Circles are bounded by polygons around them, whose corners are farther out by this factor.
constexpr int kSides = 16;
const double kOutOfCircle = 1 / std::cos(std::numbers::pi / kSides);

// Returns a polygon around the circle about a point.
Polygon Around(const Vector2& center, double radius) {
  Polygon around;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    around.push_back(center + kOutOfCircle * radius * Vector2(std::cos(angle), std::sin(angle)));
  }
  return around;
}

// Returns the shadows in world x and y.
std::vector<Polygon> ShadowsOf(const std::vector<std::vector<Vector3>>& areas) {
  std::vector<Polygon> shadows;
  for (const std::vector<Vector3>& area : areas) {
    std::vector<Vector2> shadow;
    for (const Vector3& p : area) shadow.emplace_back(p.head<2>());
    shadows.push_back(geometry::Hull2(shadow));
  }
  return shadows;
}

// Returns points of the upper part's areas of contact that are on the lower faces, however these
// are displaced by `moved` or less. The points are corners of the areas, or are inside of their
// hull.
std::vector<Vector2> SurelyTouching(const std::vector<Polygon>& areas,
                                    const std::vector<Polygon>& lower, double moved) {
  std::vector<Vector2> corners;
  for (const Polygon& area : areas) std::ranges::copy(area, std::back_inserter(corners));
  std::vector<Vector2> candidates = corners;
  const double inside = kOutOfCircle * moved + kOnTheEdge;
  for (const Polygon& area : areas)
    std::ranges::copy(geometry::Inset(area, inside), std::back_inserter(candidates));
  for (const Vector2& p : geometry::Inset(geometry::Hull2(corners), inside)) {
    const auto has = [&](const Polygon& area) { return geometry::Depth(area, p) >= 0; };
    if (std::ranges::any_of(areas, has)) candidates.push_back(p);
  }
  std::erase_if(candidates, [&](const Vector2& p) {
    return moved > kOnTheEdge && !geometry::Fills(lower, Around(p, moved));
  });
  return candidates;
}

// Returns the weight of a part and of all that stands on it. `levels` is the greatest number of
// parts that are looked at, one above the other.
double LoadOf(const UncertainWorld& world, PartId part, std::size_t levels) {
  double load = GreatestWeight(world.problem(), part);
  if (levels == 0) return load;
  for (int p = 0; p < static_cast<int>(world.problem().parts.size()); ++p) {
    const PartId other(p);
    if (other == part || other == world.in_hand()) continue;
    const auto stands_on_it = [&](const Standing& standing) { return standing.on == part; };
    if (std::ranges::any_of(StandingsOf(world, other, world.X_WorldPart(other)), stands_on_it))
      load += LoadOf(world, other, levels - 1);
  }
  return load;
}

// Returns what a pushed part passes on to a part that it stands on: the pushes and its weight.
Push PassedOn(const UncertainWorld& world, PartId part, const Standing& standing,
              const std::vector<Push>& pushes) {
  Push on = {.at = standing.at, .down = GreatestWeight(world.problem(), part)};
  for (const Push& push : pushes) {
    on.down += push.down;
    on.aside += push.aside;
  }
  return on;
}

// `levels` is the greatest number of parts that are looked at, one below the other.
double TippingDown(const UncertainWorld& world, PartId part, double clamp,
                   const std::vector<Push>& pushes, double off, std::size_t levels) {
  const Pose& X_WorldPart = world.X_WorldPart(part);
  const RestingError error = world.about_plan(part);
  const std::vector<Standing> sure = SureStandingsOf(world, part, X_WorldPart, error);
  const std::vector<TippingEdge> edges = TippingEdgesOf(sure);
  if (edges.empty() || levels == 0) return kNothingBorne;
  const double level = sure.front().at.front().z();
  double ratio = 0;
  for (const geometry::MassProperties& mass : PossibleMasses(world.problem(), part)) {
    for (const TippingEdge& edge : edges) {
      const double inside = -edge.Beyond(X_WorldPart * mass.center);
      if (!(inside > kOnTheEdge)) return kNothingBorne;
      const double moment = PressingOver(edge, level, pushes, off).moment;
      ratio = std::max(ratio, moment / ((mass.mass * kGravity + clamp) * inside));
    }
  }
  for (const Standing& standing : StandingsOf(world, part, X_WorldPart)) {
    if (standing.on.IsNone()) continue;
    std::vector<Push> on = WeightsOn(world, standing.on, part);
    on.push_back(PassedOn(world, part, standing, pushes));
    on.back().down += clamp;
    const Displaced displaced = DisplacedAgainst(world, part, X_WorldPart, error, standing.on);
    const double moved = std::max(off, FarthestOf(displaced, standing, X_WorldPart));
    ratio = std::max(ratio, TippingDown(world, standing.on, 0, on, moved, levels - 1));
  }
  return std::min(ratio, kNothingBorne);
}

// Returns the least coefficient of friction between a part and what it stands on. The engine takes
// the greater one of two parts, and tables count as smooth.
double LeastFriction(const domain::Problem& problem, PartId part, const Standing& standing) {
  double friction = problem.part(part).model->friction();
  if (!standing.on.IsNone())
    friction = std::max(friction, problem.part(standing.on).model->friction());
  return friction - problem.tolerances.friction;
}

// `push.down` is the least force that presses the part down besides its weight. `levels` is the
// greatest number of parts that are looked at, one below the other.
double SlidingDown(const UncertainWorld& world, PartId part, Push push, std::size_t levels) {
  if (push.aside == 0) return 0;
  if (levels == 0) return kNothingBorne;
  const domain::Problem& problem = world.problem();
  push.down += LeastWeight(problem, part);
  const std::vector<Standing> standings = StandingsOf(world, part, world.X_WorldPart(part));
  double ratio = standings.empty() ? kNothingBorne : 0;
  for (const Standing& standing : standings) {
    const double friction = LeastFriction(problem, part, standing);
    ratio = std::max(ratio, friction > 0 ? push.aside / (friction * push.down) : kNothingBorne);
    if (standing.on.IsNone()) continue;
    // One of several parts below may have to bear the whole push aside, and nothing of the load.
    const Push below = {
        .at = {}, .down = standings.size() == 1 ? push.down : 0, .aside = push.aside};
    ratio = std::max(ratio, SlidingDown(world, standing.on, below, levels - 1));
  }
  return std::min(ratio, kNothingBorne);
}

}  // namespace

std::vector<Standing> StandingsOf(const UncertainWorld& world, PartId part,
                                  const Pose& X_WorldPart) {
  const domain::Problem& problem = world.problem();
  const PartModel& model = *problem.part(part).model;
  std::vector<Standing> standings;
  if (std::vector<Vector3> at = domain::CornersOnTable(model, X_WorldPart); !at.empty()) {
    standings.push_back({PartId::None(), std::move(at)});
  }
  for (int p = 0; p < static_cast<int>(problem.parts.size()); ++p) {
    const PartId other(p);
    if (other == part || other == world.in_hand()) continue;
    std::vector<Vector3> at = domain::CornersOfContact(
        model, X_WorldPart, *problem.part(other).model, world.X_WorldPart(other));
    if (!at.empty()) standings.push_back({other, std::move(at)});
  }
  return standings;
}

std::vector<Standing> SureStandingsOf(const UncertainWorld& world, PartId part,
                                      const Pose& X_WorldPart, const RestingError& error) {
  const domain::Problem& problem = world.problem();
  const PartModel& model = *problem.part(part).model;
  std::vector<Standing> sure;
  for (Standing& standing : StandingsOf(world, part, X_WorldPart)) {
    if (standing.on.IsNone()) {
      sure.push_back(std::move(standing));
      continue;
    }
    const PartModel& other = *problem.part(standing.on).model;
    const Pose& X_WorldOther = world.X_WorldPart(standing.on);
    const double moved = FarthestOf(DisplacedAgainst(world, part, X_WorldPart, error, standing.on),
                                    standing, X_WorldPart) +
                         problem.tolerances.clearance;
    const auto areas = ShadowsOf(domain::AreasOfContact(model, X_WorldPart, other, X_WorldOther));
    const auto faces = ShadowsOf(domain::FacesInContact(model, X_WorldPart, other, X_WorldOther));
    Standing smaller = {standing.on, {}};
    for (const Vector2& p : SurelyTouching(areas, faces, moved))
      smaller.at.emplace_back(p.x(), p.y(), standing.at.front().z());
    if (!smaller.at.empty()) sure.push_back(std::move(smaller));
  }
  return sure;
}

std::vector<Push> WeightsOn(const UncertainWorld& world, PartId part, PartId except) {
  std::vector<Push> weights;
  const std::size_t levels = world.problem().parts.size();
  for (int p = 0; p < static_cast<int>(levels); ++p) {
    const PartId other(p);
    if (other == part || other == except || other == world.in_hand()) continue;
    for (const Standing& standing : StandingsOf(world, other, world.X_WorldPart(other))) {
      if (standing.on != part) continue;
      weights.push_back({standing.at, LoadOf(world, other, levels), 0});
    }
  }
  return weights;
}

Polygon SupportOf(const std::vector<Standing>& standings) {
  std::vector<Vector2> points;
  for (const Standing& standing : standings) {
    for (const Vector3& p : standing.at) points.emplace_back(p.head<2>());
  }
  return geometry::Hull2(points);
}

std::vector<TippingEdge> TippingEdgesOf(const std::vector<Standing>& standings) {
  const Polygon region = SupportOf(standings);
  if (region.size() < 3) return {};
  std::vector<TippingEdge> edges;
  for (std::size_t i = 0; i < region.size(); ++i) {
    const Vector2 along = region[(i + 1) % region.size()] - region[i];
    if (along.norm() < kOnTheEdge) continue;  // rounding, whose direction means nothing
    const Vector2 outward = Vector2(along.y(), -along.x()).normalized();
    edges.push_back({outward, outward.dot(region[i])});
  }
  return edges;
}

double TippingRatio(const UncertainWorld& world, PartId part, const std::vector<Push>& pushes,
                    double off) {
  const domain::Problem& problem = world.problem();
  return TippingDown(world, part, problem.part(part).clamp, pushes, off, problem.parts.size());
}

double SlidingRatio(const UncertainWorld& world, PartId part, const std::vector<Push>& pushes) {
  Push all;
  for (const Push& push : pushes) {
    all.down += push.down;
    all.aside += push.aside;
  }
  all.down += world.problem().part(part).clamp;
  return SlidingDown(world, part, all, world.problem().parts.size());
}

}  // namespace assay::uncertainty
