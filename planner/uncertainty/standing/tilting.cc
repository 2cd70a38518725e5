#include "planner/uncertainty/standing/tilting.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "planner/domain/parts/part_model.h"
#include "planner/geometry/solids/mass_properties.h"
#include "planner/uncertainty/error_sets/possible_masses.h"
#include "planner/uncertainty/standing/support.h"

namespace assay::uncertainty {
namespace {

using geometry::Matrix3;

constexpr double kAtTheEdge = 1e-9;  // metres
constexpr double kAnyTurn = 1e6;     // for each radian of lean, of a part that does not stand

// A part that rocks on its support.
struct RockingPart {
  double mass = 0;
  Matrix3 inertia;                 // about the centre of mass, in the world's axes
  std::vector<Vector3> arms;       // from the corners of the support to the centre of mass
  std::vector<TippingEdge> edges;  // of the support; the centre of mass is above the origin
};

RockingPart RockingWith(const geometry::MassProperties& mass, const Pose& X_WorldPart,
                        const std::vector<Standing>& standings) {
  const Matrix3 R_WorldPart = X_WorldPart.linear();
  const Vector3 center = X_WorldPart * mass.center;
  RockingPart part{.mass = mass.mass,
                   .inertia = R_WorldPart * mass.inertia * R_WorldPart.transpose(),
                   .arms = {},
                   .edges = TippingEdgesOf(standings)};
  for (const Standing& standing : standings) {
    for (const Vector3& corner : standing.at) part.arms.push_back(center - corner);
  }
  for (TippingEdge& edge : part.edges) edge.offset = -edge.Beyond(center);
  return part;
}

// Returns the greatest turn about the vertical for each radian of the fall, if the angular momentum
// about a vertical stays zero. The centre of mass is at `arm` from this vertical.
double TurnWithoutMoment(const RockingPart& part, const Vector3& arm) {
  const Vector3 momentum =
      part.inertia.col(2) + part.mass * (arm.squaredNorm() * Vector3::UnitZ() - arm.z() * arm);
  return momentum.head<2>().norm() / momentum.z();
}

// A side on which a part rocks, about an axis that is the same for both of its sides.
struct RockingSide {
  double offset = 0;   // distance of the side from the centre of mass
  double inertia = 0;  // about the side
  double kept = 0;     // share of the energy that a stroke on this side leaves

  // A stroke on a side leaves the angular momentum about it.
  RockingSide(double inertia_at_support, double mass, double side, double other)
      : offset(side), inertia(inertia_at_support + mass * side * side) {
    const double speed_kept = std::max(0.0, 1 - mass * side * (side + other) / inertia);
    kept = speed_kept * speed_kept;
  }
};

// Returns the greatest turn about the vertical, for each radian of the lean, after the fall, if the
// part rocks between an edge of its support and the corner that is farthest from this edge.
//
// The energy bounds the speeds s of the turn and w of the lean: s w is at most the energy divided
// by the root of the two inertias. The part rises and falls on a side in the time 2 w inertia /
// (m g offset). The energies after the strokes on the two sides are geometric series.
double TurnByRocking(const RockingPart& part, const TippingEdge& edge) {
  const Vector3 axis(-edge.outward.y(), edge.outward.x(), 0);
  double opposite = 0;  // distance of the farthest corner from the centre of mass
  double height = 0;    // of the centre of mass above the edge
  for (const Vector3& arm : part.arms) {
    const double behind = edge.outward.dot(arm.head<2>());
    opposite = std::max(opposite, behind);
    if (edge.offset + behind < kAtTheEdge) height = std::max(height, arm.z());
  }
  const double inertia = axis.dot(part.inertia * axis) + part.mass * height * height;
  const double turn_inertia = 1 / part.inertia.inverse()(2, 2);
  const RockingSide near(inertia, part.mass, edge.offset, opposite);
  const RockingSide far(inertia, part.mass, opposite, edge.offset);
  const auto turn = [&](const RockingSide& first, const RockingSide& second) {
    const double on_first = std::sqrt(first.inertia) * second.offset / first.offset;
    const double on_second = std::sqrt(second.inertia) * second.kept;
    return 2 * first.kept * (on_first + on_second) / std::sqrt(turn_inertia) /
           (1 - first.kept * second.kept);
  };
  return std::max(turn(near, far), turn(far, near));
}

double TurnByFall(const RockingPart& part) {
  double falling = TurnWithoutMoment(part, Vector3::Zero());
  for (const Vector3& arm : part.arms) falling = std::max(falling, TurnWithoutMoment(part, arm));
  double rocking = 0;
  for (const TippingEdge& edge : part.edges)
    rocking = std::max(rocking, edge.offset > 0 ? TurnByRocking(part, edge) : kAnyTurn);
  return falling + rocking;
}

}  // namespace

Vector3 MovedByTilt(const UncertainWorld& world, PartId part, const plan::Hold& hold, double tilt,
                    double off) {
  const Pose& X_WorldPart = world.X_WorldPart(part);
  const Pose X_WorldTool = X_WorldPart * hold.X_PartTool;
  const Vector3 across = X_WorldTool.linear().col(2).cross(Vector3::UnitZ()).normalized();
  Vector3 moved = Vector3::Zero();
  for (const Standing& standing : StandingsOf(world, part, X_WorldPart)) {
    for (const Vector3& corner : standing.at) {
      const Vector3 arm = X_WorldTool.translation() - corner;
      const Vector3 way = tilt * ((std::abs(across.dot(arm)) + off) * Vector3::UnitZ() +
                                  (std::abs(arm.z()) + off) * across.cwiseAbs());
      moved = moved.cwiseMax(X_WorldTool.linear().transpose().cwiseAbs() * way);
    }
  }
  return moved;
}

Fall FallOf(const UncertainWorld& world, PartId part, const Pose& X_WorldPart) {
  const std::vector<Standing> standings = StandingsOf(world, part, X_WorldPart);
  Fall fall;
  for (const geometry::MassProperties& mass : PossibleMasses(world.problem(), part))
    fall.turn = std::max(fall.turn, TurnByFall(RockingWith(mass, X_WorldPart, standings)));
  double lever = 0;
  for (const Standing& standing : standings) {
    for (const Vector3& corner : standing.at)
      lever = std::max(lever, (X_WorldPart.translation() - corner).head<2>().norm());
  }
  fall.way = world.problem().part(part).model->shape().radius() + lever * fall.turn;
  return fall;
}

}  // namespace assay::uncertainty
