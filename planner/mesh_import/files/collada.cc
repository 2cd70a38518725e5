#include "planner/mesh_import/files/collada.h"

#include <fmt/format.h>

#include <utility>

#include "planner/base/input_files/input_error.h"
#include "planner/base/module.h"
#include "planner/mesh_import/files/stl.h"

namespace assay::mesh_import {
namespace {

const ColladaLibrary& Assimp() {
  static const ColladaLibrary& library = Open<ColladaLibrary>({.file = "libassay_assimp.so",
                                                               .entry = "AssayColladaLibrary",
                                                               .needed_for = "COLLADA files",
                                                               .debian_packages = "libassimp5"});
  return library;
}

}  // namespace

TriangleMesh ReadCollada(std::string_view text, const std::string& file_name) {
  ColladaSurface surface = Assimp().Read(text);
  if (!surface.error.empty()) {
    throw InputError({file_name}, fmt::format("is no COLLADA file: {}", surface.error),
                     "a COLLADA file with triangles or polygons");
  }
  if (surface.triangles.size() > kMostTriangles) {
    throw InputError({file_name}, fmt::format("has {} triangles", surface.triangles.size()),
                     fmt::format("at most {}", kMostTriangles));
  }
  TriangleMesh mesh{.file = file_name, .vertices = std::move(surface.vertices), .triangles = {}};
  for (const std::array<int, 3>& corners : surface.triangles) {
    mesh.triangles.push_back(
        {.corners = corners, .number = static_cast<int>(mesh.triangles.size()) + 1});
  }
  return mesh;
}

}  // namespace assay::mesh_import
