#include "planner/kinematics/meshes/link_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/base/input_files/input_error.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/solids/mass_properties.h"
#include "planner/kinematics/meshes/mesh_pieces.h"
#include "planner/mesh_import/files/mesh_file.h"
#include "planner/mesh_import/repair/edge_uses.h"
#include "planner/mesh_import/repair/weld.h"

namespace assay::kinematics {
namespace {

namespace fs = std::filesystem;
using geometry::ConvexHull;
using geometry::Vector3;
using mesh_import::TriangleMesh;

constexpr std::string_view kPackage = "package://";
constexpr std::string_view kFile = "file://";
constexpr double kMostExtent = 100;  // metres

// Larger meshes are not cut, because that would take seconds.
constexpr std::size_t kMostTrianglesToCut = 20'000;

bool IsFile(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

std::optional<fs::path> FindInPackages(const fs::path& path, const fs::path& urdf,
                                       std::span<const fs::path> packages) {
  for (const fs::path& folder : packages) {
    if (IsFile(folder / path)) return folder / path;
  }
  std::error_code error;
  for (fs::path folder = fs::absolute(urdf, error).parent_path(); folder.has_relative_path();
       folder = folder.parent_path()) {
    if (IsFile(folder / path)) return folder / path;
  }
  return std::nullopt;
}

void ScaleTo(const Vector3& scale, TriangleMesh& mesh) {
  double greatest = 0;
  for (Vector3& vertex : mesh.vertices) {
    vertex = vertex.cwiseProduct(scale);
    greatest = std::max(greatest, vertex.cwiseAbs().maxCoeff());
  }
  if (scale.prod() < 0) {  // a mirrored mesh would be inside out
    for (mesh_import::Triangle& triangle : mesh.triangles) {
      std::swap(triangle.corners[1], triangle.corners[2]);
    }
  }
  if (greatest <= kMostExtent) return;
  throw InputError({.file = mesh.file}, fmt::format("a mesh that reaches {:.4g} m", greatest),
                   fmt::format("at most {} m; a URDF file scales meshes to metres", kMostExtent));
}

std::vector<SurfaceTriangle> SurfaceOf(const TriangleMesh& mesh) {
  std::vector<SurfaceTriangle> surface;
  for (const mesh_import::Triangle& triangle : mesh.triangles) {
    surface.push_back(
        {mesh.Corner(triangle, 0), mesh.Corner(triangle, 1), mesh.Corner(triangle, 2)});
  }
  return surface;
}

// Returns the volume inside of a welded mesh, or none if it is not closed.
std::optional<double> VolumeInside(const TriangleMesh& mesh) {
  bool is_closed = true;
  mesh_import::ForEachEdge(mesh_import::EdgeUsesOf(mesh), [&](const auto& uses) {
    is_closed = is_closed && mesh_import::Excess(uses) == 0;
  });
  const double volume = std::abs(mesh.Volume());
  if (!is_closed || volume == 0) return std::nullopt;
  return volume;
}

bool HasDeepDents(const ConvexHull& hull, double inside) {
  const double volume = geometry::Volume(hull);
  return volume - inside >= kLeastCutGain * volume;
}

}  // namespace

std::optional<fs::path> FindMesh(const std::string& name, const fs::path& urdf,
                                 std::span<const fs::path> packages) {
  if (name.starts_with(kPackage)) {
    return FindInPackages(name.substr(kPackage.size()), urdf, packages);
  }
  const fs::path file =
      name.starts_with(kFile) ? fs::path(name.substr(kFile.size())) : urdf.parent_path() / name;
  if (!IsFile(file)) return std::nullopt;
  return file;
}

LinkMesh ReadLinkMesh(const fs::path& file, const Vector3& scale, MeshUse use) {
  TriangleMesh mesh = mesh_import::ReadMeshFile(file);
  ScaleTo(scale, mesh);
  if (!geometry::SpanSpace(mesh.vertices, kThinnestSolid)) {
    throw InputError({.file = file.string()}, "a mesh without extent in some direction",
                     fmt::format("a mesh that is at least {} mm thick", 1e3 * kThinnestSolid));
  }
  mesh_import::Weld(mesh, kSamePoint);
  std::vector<ConvexHull> hulls = {geometry::HullOf(mesh.vertices, kSamePoint)};
  const std::optional<double> inside = VolumeInside(mesh);
  if (use == MeshUse::kCollision && inside && HasDeepDents(hulls.front(), *inside) &&
      mesh.triangles.size() <= kMostTrianglesToCut) {
    hulls = ConvexPiecesOf(SurfaceOf(mesh));
  }
  LinkMesh read;
  double volume = 0;
  for (ConvexHull& hull : hulls) {
    volume += geometry::Volume(hull);
    read.pieces.push_back(std::make_shared<const ConvexHull>(std::move(hull)));
  }
  if (inside) read.volume_ratio = volume / *inside;
  return read;
}

}  // namespace assay::kinematics
