#pragma once

#include <vector>

#include "planner/domain/problem/problem.h"

namespace assay::uncertainty {

inline constexpr double kGravity = 9.81;  // m/s^2

// Returns the mass properties that the part may have: those of the problem's own clearance, and
// those of the least and the greatest clearance. Between them the centre of mass moves on a line
// that is straight to first order.
std::vector<geometry::MassProperties> PossibleMasses(const domain::Problem& problem,
                                                     domain::PartId part);
// Returns the greatest weight of PossibleMasses, in newtons.
double GreatestWeight(const domain::Problem& problem, domain::PartId part);

}  // namespace assay::uncertainty
