#include "planner/uncertainty/error_sets/mating_end.h"

#include <algorithm>

#include "planner/algebra/expression/simplify.h"

namespace assay::uncertainty {

Transform Displaced(Transform transform, const Expression& distance, const Vector3& direction) {
  const SymbolicVector along = AsVector(direction);
  for (const int axis : {0, 1, 2}) {
    transform.translation[axis] = transform.translation[axis] + distance * along[axis];
  }
  return transform;
}

double LengthOfWay(const UncertainWorld& world, domain::MatingId mating,
                   const Expression& farther) {
  const double guarded = world.problem().workcell->rules().guarded_travel;
  return world.problem().mating(mating).mating_vector.norm() +
         std::clamp(world.RangeOf(farther).high, 0.0, guarded);
}

Transform MatingEnd::Seated() const { return Displaced(commanded, farther, motion); }

MatingEnd MatingEndOf(const UncertainWorld& world, domain::MatingId id, const plan::Hold& hold,
                      const Transform& X_ToolGrasp) {
  const domain::Mating& mating = world.problem().mating(id);
  const Pose& X_WorldFixed = world.X_WorldPart(mating.fixed);
  const Pose X_WorldTool = X_WorldFixed * mating.X_FixedHeld * hold.X_PartTool;
  MatingEnd end = {.motion = X_WorldFixed.linear() * mating.mating_vector.normalized(),
                   .fixed = PossiblePose(X_WorldFixed, world.resting(mating.fixed)),
                   .commanded = PossibleHeldPose(X_WorldTool, X_ToolGrasp, hold.X_PartTool)};
  const SymbolicVector seat = end.fixed * AsVector(mating.X_FixedHeld.translation());
  end.farther =
      algebra::Simplify(algebra::Dot(AsVector(end.motion), seat - end.commanded.translation));
  return end;
}

}  // namespace assay::uncertainty
