#pragma once

#include <vector>

#include "planner/finemotion/contacts/primitive_contact.h"

namespace assay::finemotion {

inline constexpr double kGreatestFriction = 4;  // coefficient of friction that is worth asking for

// Whether friction in the contacts that a motion keeps can hold the part however hard it is pushed
// along the displacement (shift and turn of the part, in a straight motion). Hybrid control keeps
// constant what each of them presses with, as far as wrenches tell them apart; so it can where the
// friction cones have a wrench against the motion in which none of them seems to press: they press
// against each other's friction (Whitney 1982 for a peg between two walls).
bool CanHold(const std::vector<PrimitiveContact>& kept,
             const Eigen::Matrix<double, kPoseDimensions, 1>& displacement, double friction);

// The least friction with which they can, to 1 %; kGreatestFriction if they cannot with that.
double FrictionLimit(const std::vector<PrimitiveContact>& kept,
                     const Eigen::Matrix<double, kPoseDimensions, 1>& displacement);

}  // namespace assay::finemotion
