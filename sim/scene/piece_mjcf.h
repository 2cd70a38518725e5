#pragma once

#include <string>

#include "planner/geometry/hull.h"
#include "planner/geometry/solids/mass_properties.h"
#include "sim/scene/xml_element.h"

namespace assay::scene {

// Adds a convex piece to a body, in the body's frame, and returns its geom. A box becomes a box.
// Any other solid becomes a mesh with this name, which is added under `asset`. The engine has
// vertices in single precision, so they are given from the middle of the piece: they are exact to
// about 1e-7 of its size.
XmlElement& AddPiece(const geometry::ConvexHull& piece, const std::string& geom_class,
                     const std::string& name, XmlElement& body, XmlElement& asset);

// Adds the mass, the centre of mass and the inertia of a body.
void AddMass(const geometry::MassProperties& mass, XmlElement& body);

}  // namespace assay::scene
