#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "planner/mesh_import/meshes/triangle_mesh.h"

namespace assay::mesh_import {

// The surfaces of a file that a third-party library has read, in one frame and in metres.
struct LibrarySurface {
  std::vector<Vector3> vertices;
  std::vector<std::array<int, 3>> triangles;
  std::string error;  // why the file cannot be read; empty if it can
};

// A module that reads files with a third-party library: planner/assimp, planner/opencascade.
class MeshLibrary {
 public:
  virtual ~MeshLibrary() = default;
  virtual LibrarySurface Read(std::string_view text) const = 0;
};

// Returns whether files with this ending are read by ReadLibraryMesh: COLLADA (.dae) and STEP
// (.step, .stp).
bool IsLibraryFormat(std::string_view ending);

// Reads the text of a file in such a format. All of them tell their unit. What a COLLADA file says
// about the axis that points up is ignored, as in ROS. The curved faces of a STEP file become
// triangles whose corners are on the face, with 64 sides for a circle. Throws InputError if the
// text cannot be read, and EnvironmentError if the module is missing.
TriangleMesh ReadLibraryMesh(std::string_view text, const std::string& file_name,
                             const std::string& ending);

}  // namespace assay::mesh_import
