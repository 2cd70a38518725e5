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
// A turn is a dual quaternion that is linear in the cosine and the sine of half its angle. Three
// turns have eight products of such functions, with the cosine or the sine of each turn. The
// product of the first three turns of the cycle equals the product of `motion` and the other three
// turns, backward. This equation of dual quaternions has eight components. It therefore gives the
// eight products of the first three turns as linear functions of the eight products of the other
// three.
//
// The eight products of three pairs of numbers satisfy nine quadratic equations (the minors of
// their table). The equations of the first three turns are thus equations of the other three. Let
// the searched angle be fixed, and let c, s and C, S be the half-angle functions of the other two
// angles. Then the nine equations are linear in nine monomials: each of c^2, c s, s^2 times each of
// C^2, C S, S^2. At every searched angle, the linear equations have one solution up to scale. The
// search looks for the searched angles at which this solution consists of such monomials. It
// samples a misfit, a polynomial of degree 16 in the functions of the searched angle. It takes more
// samples where the solution changes quickly. Roots are found by changes of the misfit's sign, and
// double roots as least absolute values.
std::vector<SixAngles> SolveByElimination(const SixAxes& axes, const SearchedJoint& joint,
                                          const Pose& motion);

}  // namespace assay::kinematics
