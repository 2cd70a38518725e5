#include "planner/mesh_import/files/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <vector>

#include "planner/base/input_files/input_error.h"
#include "planner/base/input_files/input_file.h"
#include "planner/mesh_import/files/library_mesh.h"
#include "planner/mesh_import/files/obj_mesh.h"
#include "planner/mesh_import/files/stl.h"

namespace assay::mesh_import {
namespace {

// Returns the ending of a file's name in small letters.
std::string EndingOf(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

}  // namespace

bool IsMeshFile(const std::filesystem::path& file) {
  const std::string ending = EndingOf(file);
  return ending == ".stl" || ending == ".obj" || IsLibraryFormat(ending);
}

bool IsInMetres(const std::filesystem::path& file) { return IsLibraryFormat(EndingOf(file)); }

const char* Name(MeshUnit unit) {
  switch (unit) {
    case MeshUnit::kMetre:
      return "m";
    case MeshUnit::kCentimetre:
      return "cm";
    case MeshUnit::kMillimetre:
      return "mm";
    case MeshUnit::kInch:
      return "inch";
  }
  return "";
}

double MetresIn(MeshUnit unit) {
  switch (unit) {
    case MeshUnit::kMetre:
      return 1;
    case MeshUnit::kCentimetre:
      return 0.01;
    case MeshUnit::kMillimetre:
      return 0.001;
    case MeshUnit::kInch:
      return 0.0254;
  }
  return 1;
}

TriangleMesh ReadMeshFile(const std::filesystem::path& file) {
  const std::string text = ReadInput(file, "a file with a mesh", kMostMeshBytes);
  const std::string ending = EndingOf(file);
  TriangleMesh mesh;
  if (ending == ".stl") {
    mesh = ReadStl(text, file.string());
  } else if (ending == ".obj") {
    mesh = ReadObjMesh(text, file.string());
  } else if (IsLibraryFormat(ending)) {
    mesh = ReadLibraryMesh(text, file.string(), ending);
  } else {
    throw InputError({file.string()}, "its name does not tell its format",
                     ".stl, .obj, .dae, .step or .stp");
  }
  if (mesh.triangles.empty()) throw InputError({file.string()}, "it has no triangles", "a surface");
  // Vertices of points and lines are not part of the surface.
  std::vector<int> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  mesh = SubMesh(mesh, all);
  return mesh;
}

std::optional<MeshUnit> LikelyUnit(double size) {
  constexpr double kLeast = 0.001;
  constexpr double kGreatestInMetres = 1;
  constexpr double kGreatestInMillimetres = 2000;
  if (!(size > kLeast) || size >= kGreatestInMillimetres) return std::nullopt;
  return size <= kGreatestInMetres ? MeshUnit::kMetre : MeshUnit::kMillimetre;
}

void ScaleToMetres(TriangleMesh& mesh, MeshUnit unit) {
  for (Vector3& vertex : mesh.vertices) vertex *= MetresIn(unit);
  const double size = mesh.Size();
  if (size >= 1e-4 && size <= 10) return;
  throw InputError({mesh.file}, fmt::format("in {} the part is {:.4g} m in size", Name(unit), size),
                   "0.1 mm to 10 m; another unit");
}

}  // namespace assay::mesh_import
