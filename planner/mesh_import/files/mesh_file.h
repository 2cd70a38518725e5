#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "planner/mesh_import/meshes/triangle_mesh.h"

namespace assay::mesh_import {

// Units of length in which meshes are written.
enum class MeshUnit { kMetre, kCentimetre, kMillimetre, kInch };
const char* Name(MeshUnit unit);  // "m", "cm", "mm", "inch"
double MetresIn(MeshUnit unit);

inline constexpr std::size_t kMostMeshBytes = std::size_t{64} << 20;

// Returns whether the ending of a name, in letters of either case, is that of a file that
// ReadMeshFile reads: .stl, .obj, or one of library_mesh.h.
bool IsMeshFile(const std::filesystem::path& file);

// Returns whether ReadMeshFile returns the mesh of this file in metres, because files of its format
// tell their unit.
bool IsInMetres(const std::filesystem::path& file);

// Reads a mesh, in metres or in the unit of the file. The ending of the file's name tells the
// format. Throws InputError.
TriangleMesh ReadMeshFile(const std::filesystem::path& file);

// Returns the unit in which parts of this size (the diagonal of the bounding box, a number of the
// file) are written: metres up to 1, else millimetres. Returns no unit for a part of 1 mm or less,
// or of 2 m or more, because no robot assembles such a part.
std::optional<MeshUnit> LikelyUnit(double size);

// Scales the mesh to metres. Throws InputError if the part is then not between 0.1 mm and 10 m.
void ScaleToMetres(TriangleMesh& mesh, MeshUnit unit);

}  // namespace assay::mesh_import
