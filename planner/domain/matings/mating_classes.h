#pragma once

#include <vector>

#include "planner/domain/matings/mating_classes.h"
#include "planner/domain/problem/problem.h"
#include "planner/domain/reachability/reachability.h"

namespace assay::domain {

// Mated parts may be this far apart where the mating motion ends, in metres.
inline constexpr double kSeatGap = 1e-4;

// Returns the least friction of mating surfaces within its tolerance, on which the friction cone
// can rely. 0 allows only straight down.
double LeastMatingFriction(const Problem& problem);

// Returns the greatest friction between the parts of a mating. It is the greatest of the friction
// in the workcell's rules and the frictions of the two parts, at the upper end of its tolerance.
double GreatestMatingFriction(const Problem& problem, const Mating& mating);

// Returns the angle of the mating vector from straight down. Its limit is the half angle of the
// friction cone. For a motion that ends on the table, the limit is zero, apart from rounding.
Limited MatingLean(const Problem& problem, const Mating& mating, const Pose& X_WorldFixed);
// Returns whether the mating vector is inside the friction cone, and EndsAboveTable holds.
bool InFrictionCone(const Problem& problem, const Mating& mating, const Pose& X_WorldFixed);
// Returns the height of the mated part's lowest point above the table, in metres.
double HeightOfMated(const Problem& problem, const Mating& mating, const Pose& X_WorldFixed);
// Returns whether the motion ends with the held part above the table, or on it. A mating that must
// end on the table (Mating::ends_on_table) must do so: the motion goes straight down, and at its
// end the held part's lowest point is level with the table.
bool EndsAboveTable(const Problem& problem, const Mating& mating, const Pose& X_WorldFixed);
// Returns whether a stable pose of the fixed part hides one of its mating features. The
// far mouth of a through hole may be hidden: the shaft enters at the other one. No pose (None)
// hides nothing.
bool HidesMatingFeatures(const Problem& problem, const Mating& mating, StablePoseId pose_of_fixed);
// Returns whether a grasp leaves the held part's mating features free. It may touch a shaft where
// the shaft is outside of its hole at the end of the mating.
bool LeavesMatingFeaturesFree(const Problem& problem, const Mating& mating, GraspId grasp);

// Returns, as labels, the grasps of the held part that suit a mating, because they hide none of the
// part's mating features (GraspList of assemble in Spar, "A Task Planning Example").
std::vector<int> GraspList(const Problem& problem, const Mating& mating);

// Returns the positions that suit a mating, as labels: the stable poses of the fixed part that hide
// none of its mating features and put the mating vector inside the friction cone (PositionList of
// assemble). The pose at the start is in the list if the stable pose to which it corresponds is in
// the list.
std::vector<int> PositionList(const Problem& problem, const Mating& mating);

}  // namespace assay::domain
