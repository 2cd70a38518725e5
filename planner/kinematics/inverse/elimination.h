#pragma once

#include <vector>

#include "planner/kinematics/inverse/closed_form.h"

namespace assay::kinematics {

// Which joint is found first. The six joints are read as a cycle that starts at joint `start`. The
// searched joint is number `searched` (0 to 2) of the second three of the cycle.
struct SearchedJoint {
  int start = 0;
  int searched = 0;

  int joint() const { return (start + 3 + searched) % 6; }
};

// Returns approximate joint values for which the product of the six turns is `motion`: all
// solutions, and some that are none. The caller refines and tests them.
//
// A turn is a dual quaternion that is linear in the cosine and the sine of half its angle. The
// product of the first three turns of the cycle equals that of the other three, turned backward, so
// the products of half-angle functions of the first three are linear in those of the other three.
// The eight products of three pairs of numbers satisfy nine quadratic equations (the minors of
// their table). With the searched angle fixed, the nine equations are linear in the nine products
// of squares and products of the other two angles' functions. At every angle they have one solution
// up to scale. The search looks for angles at which this solution consists of squares and products:
// it samples a misfit, a polynomial of degree 16 in the functions of the angle, at 160 angles.
// Roots are found by changes of its sign, and double roots as least absolute values.
std::vector<SixAngles> SolveByElimination(const SixAxes& axes, const SearchedJoint& joint,
                                          const Pose& motion);

}  // namespace assay::kinematics
