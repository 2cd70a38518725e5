#include "planner/uncertainty/error_sets/turn_of_push.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "planner/domain/parts/exposed_faces.h"
#include "planner/domain/parts/part_model.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/solids/mass_properties.h"
#include "planner/uncertainty/error_sets/possible_masses.h"
#include "planner/uncertainty/preconditions/support.h"

namespace assay::uncertainty {
namespace {

constexpr double kTurn = 0.55;
// The mean distance from the centre of a convex region, divided by its radius of gyration.
constexpr double kMeanOfGyration = 0.85;

// Returns the regions in which the part touches what it stands on: the patches of the face that
// looks down. A part without such a face stands on edges and corners.
std::vector<geometry::Polygon> RegionsOf(const domain::PartModel& model, const Pose& X_WorldPart) {
  const Vector3 down = X_WorldPart.linear().transpose() * -Vector3::UnitZ();
  double offset = -std::numeric_limits<double>::infinity();
  for (const Vector3& v : model.corners()) offset = std::max(offset, down.dot(v));
  const domain::FaceId face = domain::FindFace(model.faces(), down, offset);
  return face.IsNone() ? std::vector<geometry::Polygon>{} : model.faces()[face.index()].patches;
}

// Returns r of the part with this centre of mass, in metres; 0 if nothing keeps it from turning.
double RadiusOfFriction(const geometry::Polygon& support,
                        std::span<const geometry::Polygon> regions, const Vector2& center) {
  if (support.size() < 3) return 0;
  if (regions.empty()) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vector2& corner : support) nearest = std::min(nearest, (corner - center).norm());
    return nearest;
  }
  const double inside = geometry::Depth(support, center);
  const double at_most = geometry::Depth(support, geometry::Centroid(support));
  return kMeanOfGyration * std::clamp(inside / at_most, 0.0, 1.0) *
         geometry::RadiusOfGyration(regions);
}

}  // namespace

double TurnOfPush(const UncertainWorld& world, PartId part, const Pose& X_WorldPart, double way) {
  if (way == 0) return 0;
  const domain::PartModel& model = *world.problem().part(part).model;
  const geometry::Polygon support = SupportOf(StandingsOf(world, part, X_WorldPart));
  const std::vector<geometry::Polygon> regions = RegionsOf(model, X_WorldPart);
  double radius = std::numeric_limits<double>::infinity();
  for (const geometry::MassProperties& mass : PossibleMasses(world.problem(), part)) {
    const Vector2 center = (X_WorldPart * mass.center).head<2>();
    const Vector3 up = X_WorldPart.linear().transpose() * Vector3::UnitZ();
    radius = std::min({radius, RadiusOfFriction(support, regions, center),
                       std::sqrt(up.dot(mass.inertia * up) / mass.mass)});
  }
  return radius > 0 ? std::min(kTurn * way / radius, std::numbers::pi) : std::numbers::pi;
}

}  // namespace assay::uncertainty
