#include "planner/uncertainty/standing/tilting.h"

#include <cmath>

#include "planner/uncertainty/standing/support.h"

namespace assay::uncertainty {

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

}  // namespace assay::uncertainty
