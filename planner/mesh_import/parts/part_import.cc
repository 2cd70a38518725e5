#include "planner/mesh_import/parts/part_import.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "planner/base/input_files/input_error.h"
#include "planner/mesh_import/parts/part_features.h"
#include "planner/mesh_import/repair/mesh_repair.h"

namespace assay::mesh_import {
namespace {

constexpr std::size_t kMostBodies = 100;

// Returns the unit of the files that do not tell it, if there are any: the unit asked for, or the
// one that the size of the part suggests.
std::optional<MeshUnit> UnitOf(const std::vector<TriangleMesh>& meshes,
                               const ImportOptions& options) {
  Eigen::AlignedBox3d bounds;
  for (const TriangleMesh& mesh : meshes) {
    if (!IsInMetres(mesh.file)) bounds.extend(mesh.Bounds());
  }
  if (bounds.isEmpty()) {
    if (!options.unit) return std::nullopt;
    throw InputError({meshes.front().file}, "the file tells its unit", "no option --units");
  }
  if (options.unit) return options.unit;
  const double size = bounds.diagonal().norm();
  if (const std::optional<MeshUnit> unit = LikelyUnit(size)) return unit;
  throw InputError({meshes.front().file},
                   fmt::format("the part is {:.4g} in size, which does not tell its unit", size),
                   "the option --units");
}

// A closed body of a file.
struct FileBody {
  TriangleMesh mesh;
  std::string file;
};

// Returns the bodies of all files, in metres, the largest first. Notes the repairs.
std::vector<FileBody> BodiesOf(std::vector<TriangleMesh> meshes, ImportedPart& part) {
  std::vector<FileBody> bodies;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    ScaleToMetres(meshes[i], IsInMetres(meshes[i].file) ? MeshUnit::kMetre : *part.unit);
    RepairedMesh repaired = Repair(std::move(meshes[i]));
    for (const std::string& repair : repaired.repairs)
      part.repairs.push_back(part.files[i] + ": " + repair);
    for (TriangleMesh& body : repaired.bodies) bodies.push_back({std::move(body), part.files[i]});
  }
  if (bodies.size() > kMostBodies) {
    throw InputError({bodies.front().mesh.file},
                     fmt::format("the files have {} bodies together", bodies.size()),
                     fmt::format("at most {}", kMostBodies));
  }
  std::ranges::stable_sort(bodies, std::ranges::greater(),
                           [](const FileBody& body) { return body.mesh.Volume(); });
  return bodies;
}

}  // namespace

ImportedPart Import(const std::vector<std::filesystem::path>& files, const std::string& name,
                    const ImportOptions& options) {
  ImportedPart part;
  part.options = options;
  std::vector<TriangleMesh> meshes;
  for (const std::filesystem::path& file : files) {
    meshes.push_back(ReadMeshFile(file));
    part.files.push_back(file.filename().string());
    part.triangles += static_cast<int>(meshes.back().triangles.size());
  }
  part.unit = UnitOf(meshes, options);
  std::vector<BodyShape> shapes;
  for (const FileBody& body : BodiesOf(std::move(meshes), part)) {
    for (BodyShape& shape : ShapesOf(body.mesh)) {
      shapes.push_back(shape);
      part.bodies.push_back({.file = body.file, .shape = std::move(shape)});
    }
  }
  part.sketch = SketchOf(name, shapes);
  AddFeatures(part.sketch);
  return part;
}

}  // namespace assay::mesh_import
