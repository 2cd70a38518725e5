#pragma once

#include "planner/uncertainty/error_sets/uncertain_world.h"

namespace assay::uncertainty {

// The place where a straight mating motion may end.
struct MatingEnd {
  Vector3 motion;          // unit vector along the motion, in the world as planned
  Transform fixed;         // pose of the fixed part in the world
  Transform commanded;     // commanded end pose of the held part in the world
  Expression farther = 0;  // metres along the motion from `commanded` to the seat

  Transform Seated() const;  // pose of the held part in the world, in its seat
};
MatingEnd MatingEndOf(const UncertainWorld& world, domain::MatingId mating, const plan::Hold& hold,
                      const Transform& X_ToolGrasp);

// Returns how far before its end a straight mating motion may have begun, in metres.
double LengthOfWay(const UncertainWorld& world, domain::MatingId mating, const Expression& farther);

// Returns the uncertain transform displaced by `distance` metres along a direction.
Transform Displaced(Transform transform, const Expression& distance, const Vector3& direction);

}  // namespace assay::uncertainty
