#pragma once

#include <string>

#include "planner/domain/problem/problem.h"
#include "planner/motion/collision/surroundings.h"

namespace assay::motion {

using domain::GraspId;

// Returns whether the robot that acts can take the part by this grasp where it stands alone, at
// X_WorldPart, and put it down there. Four conditions must hold. The arm goes the straight ways of
// pickup and putdown (domain::IsReachableAt). The volume of the way up from the grasp (SweptVolume)
// stays clear of table, floor and other robots at their homes. The arm does not touch itself at the
// grasp. A path from its own home leads to where the way begins (FindPath).
bool CanServe(const domain::Problem& problem, PartId part, GraspId grasp, const Pose& X_WorldPart);

// Returns the first grasp for which CanServe is true, or None if there is none. This is the extern
// isReachable(location, robot) of the visual scenario (Gaschler et al. 2013, III-B).
GraspId ServingGrasp(const domain::Problem& problem, PartId part, const Pose& X_WorldPart);

// Returns, for a part that no grasp serves, which conditions fail and for how many of the grasps.
std::string WhyNotServed(const domain::Problem& problem, PartId part, const Pose& X_WorldPart);

}  // namespace assay::motion
