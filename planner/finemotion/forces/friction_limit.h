#pragma once

#include <vector>

#include "planner/finemotion/contacts/primitive_contact.h"

namespace assay::finemotion {

inline constexpr double kGreatestFriction = 4;  // greatest coefficient of friction that is tried

// Returns whether friction in the kept contacts can hold the part however hard it is pushed along
// the displacement (shift and turn of the part, in a straight motion). Hybrid control keeps the
// force of each kept contact constant, as far as wrenches distinguish the contacts. The part can
// therefore be held if the friction cones have a wrench against the motion in which no contact
// seems to press. The contacts then press against each other's friction (Whitney 1982 for a peg
// between two walls).
bool CanHold(const std::vector<PrimitiveContact>& kept,
             const Eigen::Matrix<double, kPoseDimensions, 1>& displacement, double friction);

// Returns the least coefficient of friction with which the contacts can hold the part, to 1 %, or
// kGreatestFriction if they cannot hold the part even with that.
double FrictionLimit(const std::vector<PrimitiveContact>& kept,
                     const Eigen::Matrix<double, kPoseDimensions, 1>& displacement);

}  // namespace assay::finemotion
