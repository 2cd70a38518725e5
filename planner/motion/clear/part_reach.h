#pragma once

#include <string>

#include "planner/domain/problem/problem.h"
#include "planner/motion/clear/collision_scene.h"

namespace assay::motion {

using domain::GraspId;

// Whether the robot that acts can take the part by this grasp where it stands alone, at
// X_WorldPart, and put it down there: the arm goes the straight ways of pickup and putdown
// (domain::IsReachableAt); the volume of the way up from the grasp (SweptVolume) stays clear of
// table, floor and other robots at their homes; at the grasp the arm does not touch itself; and a
// path from its own home leads to where the way begins (FindPath).
bool CanServe(const domain::Problem& problem, PartId part, GraspId grasp, const Pose& X_WorldPart);

// The same by any grasp: the first by which it can, None if there is none. This is the extern
// isReachable(location, robot) of the visual scenario (Gaschler et al. 2013, III-B).
GraspId ServingGrasp(const domain::Problem& problem, PartId part, const Pose& X_WorldPart);

// Where there is none: which conditions are not true, and for how many of the grasps.
std::string WhyNotServed(const domain::Problem& problem, PartId part, const Pose& X_WorldPart);

}  // namespace assay::motion
