#pragma once

#include "planner/motion/collision/motion_check.h"
#include "planner/plan/data/reason.h"

namespace assay::motion {

// Returns the situation in which the arm has this posture amid the surroundings.
plan::Situation SituationAt(const JointVector& q, const domain::Workcell& workcell,
                            const Surroundings& surroundings);

// Returns the situation of an obstruction, with the bodies that come too near to each other.
plan::Situation SituationOf(const Obstruction& obstruction, const CollisionScene& scene,
                            const Surroundings& surroundings);

}  // namespace assay::motion
