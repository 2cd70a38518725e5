#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/finemotion/contacts/primitive_contact.h"
#include "planner/plan/data/strategy.h"

namespace assay::finemotion {

// Force (newtons) and torque about the moving part's origin (newton metres), in the stationary
// part's axes.
using Wrench = Eigen::Matrix<double, kPoseDimensions, 1>;

// What the stationary part can do to the moving one in a contact state: the wrenches that are
// nonnegative combinations of the rays (Dakin and Popplestone, section 4: what tells states apart
// at the wrist). No contact: only the wrench 0.
struct ForceSignature {
  Eigen::Matrix<double, kPoseDimensions, Eigen::Dynamic> rays;  // a column each
};

// Of contacts with dry friction: the edges of a pyramid of `sides` sides about each friction cone,
// so that whatever the cones allow is in it. Without friction: the normals.
ForceSignature SignatureOf(const std::vector<PrimitiveContact>& contacts, double friction,
                           int sides = 8);
ForceSignature SignatureOf(const std::vector<plan::StrategyContact>& contacts, double friction,
                           int sides = 8);

// In these functions torques are divided by `length` (metres, about half the part's size), so that
// they compare with forces. Rays and wrenches count by their directions.

// The sine of the angle between the wrench and the nearest of the signature; 1 if none is nearer
// than at a right angle.
double Separation(const Wrench& wrench, const ForceSignature& signature, double length);

// The least distance between a mean of the unit rays of one signature and the other's wrenches, in
// 0 .. 1: 0 where they have a wrench in common, the sine of the angle where both are single rays.
double Separation(const ForceSignature& a, const ForceSignature& b, double length);

// Of contact states that have contacts in common: which of them press, and how much, does not tell
// the states apart, so that only what is not in both counts. The least distance between a mean of
// the unit rays that only one of the states has and the other state's wrenches, in 0 .. 1: 0 where
// what is new in one of them may as well be the other; 1 where no wrench is new.
double SeparationOfStates(const ForceSignature& common, const ForceSignature& only_a,
                          const ForceSignature& only_b, double length);

// The part does not move although `applied` pushes it: the contacts can hold it by friction alone
// (Simunovic 1975). Conservative, as pyramids are.
bool Jams(const ForceSignature& signature, const Wrench& applied, double length);

// The contacts can squeeze the part between them whatever is applied: some of their forces, not all
// 0, come to nothing together (Nevins and Whitney 1978: contacts in each other's friction cones).
bool Wedges(const ForceSignature& signature, double length);

}  // namespace assay::finemotion
