#pragma once

#include "planner/kinematics/urdf_model.h"

namespace assay::kinematics {

// Returns two bodies that are fixed to each other as one, with the first one's frame.
Inertial Joined(const Inertial& a, const Inertial& b);

// Returns a body's inertia in another frame, in which the body's frame has this pose.
Inertial Moved(const Pose& X_NewBody, Inertial inertial);

// Adds the shapes, the meshes and the inertia of a link to a body to which it is fixed.
void AddFixedLink(const Link& link, const Pose& X_BodyLink, Link& body);

}  // namespace assay::kinematics
