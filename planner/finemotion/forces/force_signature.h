#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/finemotion/contacts/primitive_contact.h"
#include "planner/plan/data/strategy.h"

namespace assay::finemotion {

// A force (newtons) and a torque about the moving part's origin (newton metres), in the stationary
// part's axes.
using Wrench = Eigen::Matrix<double, kPoseDimensions, 1>;

// The wrenches that the stationary part can apply to the moving part in a contact state: all
// nonnegative combinations of the rays (Dakin and Popplestone, section 4, use them to distinguish
// states at the wrist). Without a contact it is the wrench 0 alone.
struct ForceSignature {
  Eigen::Matrix<double, kPoseDimensions, Eigen::Dynamic> rays;  // one column for each ray
};

// Returns the signature of contacts with dry friction. Its rays are the edges of a pyramid of
// `sides` sides about each friction cone, so it contains whatever the cones allow. Without
// friction, the rays are the normals.
ForceSignature SignatureOf(const std::vector<PrimitiveContact>& contacts, double friction,
                           int sides = 8);
ForceSignature SignatureOf(const std::vector<plan::StrategyContact>& contacts, double friction,
                           int sides = 8);

// In the functions below, torques are divided by `length` (metres, about half the part's size) so
// that they compare with forces. Only the directions of rays and wrenches matter.

// Returns the sine of the angle between the wrench and the nearest wrench of the signature, or 1 if
// that angle is at least a right angle.
double Separation(const Wrench& wrench, const ForceSignature& signature, double length);

// Returns the least distance between a mean of the unit rays of one signature and the wrenches of
// the other, in 0 .. 1. The result is 0 if the two signatures have a wrench in common. If both
// signatures are single rays, the result is the sine of the angle between these rays.
double Separation(const ForceSignature& a, const ForceSignature& b, double length);

// Returns the separation of two contact states that have contacts in common. The forces of the
// common contacts do not distinguish the states, so only the other contacts count. The result is
// the least distance, in 0 .. 1, between a mean of the unit rays that only one state has and the
// wrenches of the other state. It is 0 where a new wrench of one state may as well come from the
// other, and 1 where no wrench is new.
double SeparationOfStates(const ForceSignature& common, const ForceSignature& only_a,
                          const ForceSignature& only_b, double length);

// Returns whether the contacts can hold the part by friction alone although `applied` pushes it
// (Simunovic 1975). It is conservative, since the pyramids contain the friction cones.
bool Jams(const ForceSignature& signature, const Wrench& applied, double length);

// Returns whether the contacts can squeeze the part between them, whatever wrench is applied. They
// can if some of their forces, not all 0, cancel each other (Nevins and Whitney 1978: contacts in
// each other's friction cones).
bool Wedges(const ForceSignature& signature, double length);

}  // namespace assay::finemotion
