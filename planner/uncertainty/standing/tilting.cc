#include "planner/uncertainty/standing/tilting.h"

#include <algorithm>
#include <cmath>

#include "planner/geometry/solids/mass_properties.h"
#include "planner/uncertainty/error_sets/possible_masses.h"
#include "planner/uncertainty/standing/support.h"

namespace assay::uncertainty {
namespace {

using geometry::Matrix3;

// Returns the greatest turn about a vertical axis for each radian of a turn about horizontal ones,
// if the angular momentum about the vertical axis stays zero. `inertia` is about the centre of
// mass, which is at `arm` from the axis.
double TurnWithoutMoment(const Matrix3& inertia, double mass, const Vector3& arm) {
  const Vector3 vertical =
      inertia.col(2) + mass * (arm.squaredNorm() * Vector3::UnitZ() - arm.z() * arm);
  return vertical.head<2>().norm() / vertical.z();
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

double TurnByFall(const UncertainWorld& world, PartId part, const Pose& X_WorldPart) {
  double turn = 0;
  for (const geometry::MassProperties& mass : PossibleMasses(world.problem(), part)) {
    const Matrix3 R_WorldPart = X_WorldPart.linear();
    const Matrix3 inertia = R_WorldPart * mass.inertia * R_WorldPart.transpose();
    turn = std::max(turn, TurnWithoutMoment(inertia, mass.mass, Vector3::Zero()));
    for (const Standing& standing : StandingsOf(world, part, X_WorldPart)) {
      for (const Vector3& corner : standing.at) {
        const Vector3 arm = X_WorldPart * mass.center - corner;
        turn = std::max(turn, TurnWithoutMoment(inertia, mass.mass, arm));
      }
    }
  }
  return turn;
}

}  // namespace assay::uncertainty
