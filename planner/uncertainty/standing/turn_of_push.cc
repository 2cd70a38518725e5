#include "planner/uncertainty/standing/turn_of_push.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "planner/domain/parts/exposed_faces.h"
#include "planner/domain/parts/part_model.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/solids/mass_properties.h"
#include "planner/uncertainty/error_sets/possible_masses.h"
#include "planner/uncertainty/standing/support.h"

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

// Returns whether p is in the triangle, up to rounding.
bool IsInTriangle(const std::array<Vector2, 3>& t, const Vector2& p) {
  constexpr double kOnSide = 1e-12;  // square metres
  int left = 0;
  int right = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector2 side = t[(i + 1) % 3] - t[i];
    const Vector2 to = p - t[i];
    const double area = side.x() * to.y() - side.y() * to.x();
    left += area >= -kOnSide ? 1 : 0;
    right += area <= kOnSide ? 1 : 0;
  }
  return left == 3 || right == 3;
}

// Returns the mean distance of a triangle's corners from a point. Corners that bear a body with
// this centre of mass count by what they bear.
double MeanDistance(const std::array<Vector2, 3>& t, const Vector2& center, const Vector2& about) {
  Eigen::Matrix3d balance;
  Vector3 distances;
  for (int i = 0; i < 3; ++i) {
    const Vector2& corner = t[static_cast<std::size_t>(i)];
    balance.col(i) << corner, 1;
    distances[i] = (corner - about).norm();
  }
  const Vector3 shares = balance.fullPivLu().solve(Vector3(center.x(), center.y(), 1));
  return shares.cwiseMax(0).dot(distances) / shares.cwiseMax(0).sum();
}

// Returns the greatest mean distance, in metres, from a point to where a support bears a body with
// this centre of mass. The mean is greatest where three corners of the support bear the body.
double GreatestMeanDistance(const geometry::Polygon& support, const Vector2& center,
                            const Vector2& about) {
  double greatest = (center - about).norm();
  for (std::size_t i = 0; i < support.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        const std::array triangle = {support[i], support[j], support[k]};
        if (!IsInTriangle(triangle, center)) continue;
        greatest = std::max(greatest, MeanDistance(triangle, center, about));
      }
    }
  }
  return greatest;
}

}  // namespace

double RadiusAgainstTurn(const UncertainWorld& world, PartId part, const Pose& X_WorldPart,
                         const Segment& about) {
  const geometry::Polygon support = SupportOf(StandingsOf(world, part, X_WorldPart));
  const Vector2 along = about.to - about.from;
  double radius = 0;
  for (const geometry::MassProperties& mass : PossibleMasses(world.problem(), part)) {
    const Vector2 center = (X_WorldPart * mass.center).head<2>();
    const double share = along.dot(center - about.from) / along.squaredNorm();
    const Vector2 nearest = about.from + std::clamp(share, 0.0, 1.0) * along;
    radius = std::max(radius, GreatestMeanDistance(support, center, nearest));
  }
  return radius;
}

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
