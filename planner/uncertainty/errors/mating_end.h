#pragma once

#include "planner/uncertainty/errors/uncertain_world.h"

namespace assay::uncertainty {

// Where a straight mating motion may end.
struct MatingEnd {
  Vector3 motion;          // unit, in the world as planned
  Transform fixed;         // of the fixed part, in the world
  Transform told;          // of the held part, in the world, where the hand is told to end
  Expression farther = 0;  // metres along the motion from there to the seat

  Transform Seated() const;  // of the held part, in the world
};
MatingEnd MatingEndOf(const UncertainWorld& world, domain::MatingId mating, const plan::Hold& hold,
                      const Transform& X_ToolGrasp);

// How far before its end a straight mating motion may have begun, metres.
double LengthOfWay(const UncertainWorld& world, domain::MatingId mating, const Expression& farther);

// The transform displaced by so many metres along a direction.
Transform Displaced(Transform transform, const Expression& distance, const Vector3& direction);

}  // namespace assay::uncertainty
