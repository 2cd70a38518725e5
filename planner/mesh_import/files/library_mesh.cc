#include "planner/mesh_import/files/library_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "planner/base/input_files/input_error.h"
#include "planner/base/module.h"
#include "planner/mesh_import/files/stl.h"

namespace assay::mesh_import {
namespace {

const MeshLibrary& Assimp() {
  static const MeshLibrary& library = Open<MeshLibrary>({.file = "libassay_assimp.so",
                                                         .entry = "AssayAssimpReader",
                                                         .needed_for = "COLLADA files",
                                                         .debian_packages = "libassimp5"});
  return library;
}

// The module is built only where OpenCASCADE is installed.
const MeshLibrary& OpenCascade() {
  static const MeshLibrary& library = Open<MeshLibrary>(
      {.file = "libassay_opencascade.so",
       .entry = "AssayStepReader",
       .needed_for = "STEP files",
       .debian_packages = "libocct-data-exchange-dev libocct-modeling-algorithms-dev, and build "
                          "the program again"});
  return library;
}

struct Format {
  std::string_view ending;
  const char* name;
  const MeshLibrary& (*library)();
};

constexpr std::array kFormats = {
    Format{".dae", "COLLADA", Assimp},
    Format{".step", "STEP", OpenCascade},
    Format{".stp", "STEP", OpenCascade},
};

const Format* FormatOf(std::string_view ending) {
  const auto* const format = std::ranges::find(kFormats, ending, &Format::ending);
  return format == kFormats.end() ? nullptr : format;
}

}  // namespace

bool IsLibraryFormat(std::string_view ending) { return FormatOf(ending) != nullptr; }

TriangleMesh ReadLibraryMesh(std::string_view text, const std::string& file_name,
                             const std::string& ending) {
  const Format& format = *FormatOf(ending);
  LibrarySurface surface = format.library().Read(text);
  if (!surface.error.empty()) {
    throw InputError({file_name}, fmt::format("is no {} file: {}", format.name, surface.error),
                     fmt::format("a {} file with surfaces", format.name));
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
