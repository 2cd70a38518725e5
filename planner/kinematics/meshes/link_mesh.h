#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/geometry/coordinates.h"

namespace assay::geometry {
struct ConvexHull;
}  // namespace assay::geometry

namespace assay::kinematics {

// Returns the file that a link of a URDF file names: package://PACKAGE/PATH, file://PATH, or a path
// from the folder of the URDF file. A package is a folder with the package's name. It is searched
// for in `packages`, and then in the folders around the URDF file, the nearest first. Returns none
// if there is no such file.
std::optional<std::filesystem::path> FindMesh(const std::string& name,
                                              const std::filesystem::path& urdf,
                                              std::span<const std::filesystem::path> packages);

// What a mesh of a link is for. A mesh that is drawn becomes its hull. So does a mesh for
// collisions, unless it is closed, has at most 20,000 triangles, and its hull is much larger than
// the solid. Then it is cut into convex pieces (mesh_pieces.h).
enum class MeshUse { kDrawing, kCollision };

// The convex pieces of a mesh.
struct LinkMesh {
  std::vector<std::shared_ptr<const geometry::ConvexHull>> pieces;
  // The volume of the pieces, divided by that of the mesh. None if the mesh is not closed.
  std::optional<double> volume_ratio;
};

// Reads a file of a format of mesh_import. `scale` leads from the numbers of the file to metres.
// Throws InputError if the file cannot be read, is larger than 100 m, or spans no space.
LinkMesh ReadLinkMesh(const std::filesystem::path& file, const geometry::Vector3& scale,
                      MeshUse use);

}  // namespace assay::kinematics
