#include "planner/kinematics/link_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

#include "planner/base/input_files/input_error.h"
#include "planner/geometry/hull.h"
#include "planner/mesh_import/files/mesh_file.h"

namespace assay::kinematics {
namespace {

namespace fs = std::filesystem;
using geometry::Vector3;

constexpr std::string_view kPackage = "package://";
constexpr std::string_view kFile = "file://";
constexpr double kMostExtent = 100;  // metres
constexpr double kThinnest = 1e-5;   // metres
constexpr double kSamePoint = 1e-6;  // metres; nearer corners count as one

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

bool IsReadableMesh(const std::string& name) {
  std::string ending = fs::path(name).extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".stl" || ending == ".obj";
}

std::shared_ptr<const geometry::ConvexHull> ReadMeshHull(const fs::path& file,
                                                         const Vector3& scale) {
  std::vector<Vector3> corners = mesh_import::ReadMeshFile(file).vertices;
  double greatest = 0;
  for (Vector3& corner : corners) {
    corner = corner.cwiseProduct(scale);
    greatest = std::max(greatest, corner.cwiseAbs().maxCoeff());
  }
  if (!(greatest <= kMostExtent)) {
    throw InputError({.file = file.string()}, fmt::format("a mesh that reaches {:.4g} m", greatest),
                     fmt::format("at most {} m; a URDF file scales meshes to metres", kMostExtent));
  }
  if (!geometry::SpanSpace(corners, kThinnest)) {
    throw InputError({.file = file.string()}, "a mesh without extent in some direction",
                     fmt::format("a mesh that is at least {} mm thick", 1e3 * kThinnest));
  }
  return std::make_shared<const geometry::ConvexHull>(geometry::HullOf(corners, kSamePoint));
}

}  // namespace assay::kinematics
