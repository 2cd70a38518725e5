#pragma once

#include <optional>

#include "planner/kinematics/urdf_model.h"

namespace assay::kinematics {

// The density of links whose file gives no mass, kg/m^3. Links of arms with their motors have about
// this density within their outer shapes.
inline constexpr double kDerivedDensity = 1000;

// Returns the inertia of a body of this density with the collision shapes of the link, or none if
// it has no such shapes. What is in several shapes counts several times.
std::optional<Inertial> DerivedInertial(const Link& link);

}  // namespace assay::kinematics
