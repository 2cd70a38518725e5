#pragma once

#include <vector>

#include "planner/domain/matings/mating_classes.h"
#include "planner/domain/problem/problem.h"
#include "planner/domain/reachability/reachability.h"

namespace assay::domain {

// Returns the least friction of mating surfaces within its tolerance, on which the friction cone
// can rely. 0 allows only straight down.
double LeastMatingFriction(const Problem& problem);

// Returns the angle of the mating vector from straight down, with the friction cone's half angle as
// its limit.
Limited MatingLean(const Problem& problem, const Mating& mating, const Pose& X_WorldFixed);
// Returns whether the mating vector is inside the friction cone.
bool InFrictionCone(const Problem& problem, const Mating& mating, const Pose& X_WorldFixed);
// Returns whether a stable pose of the fixed part hides one of its mating features.
bool HidesMatingFeatures(const Problem& problem, const Mating& mating, StablePoseId pose_of_fixed);
// Returns whether a grasp leaves the held part's mating features free. It may touch a shaft where
// the shaft is outside of its hole at the end of the mating.
bool LeavesMatingFeaturesFree(const Problem& problem, const Mating& mating, GraspId grasp);

// Returns the grasps that suit a mating, as labels: those of the held part that hide none of its
// mating features (GraspList of assemble in Spar, "A Task Planning Example").
std::vector<int> GraspList(const Problem& problem, const Mating& mating);

// Returns the positions that suit a mating, as labels: the stable poses of the fixed part that hide
// none of its mating features and put the mating vector inside the friction cone (PositionList of
// assemble). The pose at the start is in the list if the stable pose that it corresponds to is.
std::vector<int> PositionList(const Problem& problem, const Mating& mating);

}  // namespace assay::domain
