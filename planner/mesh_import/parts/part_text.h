#pragma once

#include <string>

#include "planner/mesh_import/parts/part_sketch.h"

namespace assay::mesh_import {

// Properties of a part that a mesh does not contain.
struct PartMaterial {
  double density = 1000;  // kg/m^3
  double friction = 0.3;  // of the material against itself
};

// Returns the label with which the poses of a part begin: the first letters of the words of its
// name, at most three capitals.
std::string InitialOf(const std::string& name);

// Returns a length in millimetres, to 0.1 micrometre: "16.5".
std::string Millimetres(double metres);

// Returns the text of the part file (assay-part/1). Round posts have `sides` sides.
std::string PartText(const PartSketch& sketch, const PartMaterial& material, int sides);

// Returns the name of the file beside the part file that has the pieces of a solid.
std::string PieceFileName(const SketchSolid& solid);
// Returns the convex pieces of a solid as OBJ, in millimetres, each as an object.
std::string PieceText(const SketchSolid& solid);

}  // namespace assay::mesh_import
