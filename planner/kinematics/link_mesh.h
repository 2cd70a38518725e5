#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

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

// Returns whether the hulls of such files can be read. They end in .stl or .obj.
bool IsReadableMesh(const std::string& name);

// Returns the convex hull of the corners of an STL or OBJ file. `scale` leads from the numbers of
// the file to metres. Throws InputError if the file cannot be read, is larger than 100 m, or spans
// no space.
std::shared_ptr<const geometry::ConvexHull> ReadMeshHull(const std::filesystem::path& file,
                                                         const geometry::Vector3& scale);

}  // namespace assay::kinematics
