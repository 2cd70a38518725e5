#pragma once

#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/kinematics/dynamics/arm_dynamics.h"

namespace assay::uncertainty {

using kinematics::kGravity;

// Returns the mass properties that the part may have, for three clearances: the problem's own, the
// least and the greatest. Between these clearances, the centre of mass moves on a line that is
// straight to first order.
std::vector<geometry::MassProperties> PossibleMasses(const domain::Problem& problem,
                                                     domain::PartId part);
// Return the greatest and the least weight of PossibleMasses, in newtons.
double GreatestWeight(const domain::Problem& problem, domain::PartId part);
double LeastWeight(const domain::Problem& problem, domain::PartId part);

}  // namespace assay::uncertainty
