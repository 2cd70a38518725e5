#include "planner/mesh_import/files/obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "planner/base/input_files/quotation.h"
#include "planner/mesh_import/files/stl.h"
#include "planner/mesh_import/files/text_words.h"
#include "planner/mesh_import/meshes/planar_triangulation.h"

namespace assay::mesh_import {
namespace {

constexpr std::size_t kMostCorners = 10'000;  // of a face
constexpr std::array<std::string_view, 13> kSkipped = {
    "vn", "vt", "vp", "o", "g", "s", "l", "p", "mg", "usemtl", "mtllib", "lod", "usemap"};

// Returns the index of a vertex that a word like 3, 3/1, 3//2 or -1 names. Negative numbers count
// back from the last vertex.
int VertexOf(const TextWords& words, std::string_view word, std::size_t count) {
  const std::string_view digits = word.substr(0, word.find('/'));
  long number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const bool is_number = error == std::errc() && end == digits.data() + digits.size();
  const long index = number < 0 ? static_cast<long>(count) + number : number - 1;
  if (!is_number || index < 0 || index >= static_cast<long>(count)) {
    words.Fail(
        Quote(word) + " names no vertex",
        count == 0 ? "vertices before faces" : fmt::format("1 to {} (or -{} to -1)", count, count));
  }
  return static_cast<int>(index);
}

// Splits a face into triangles in its plane.
void AddFace(const TextWords& words, const Loop& corners, int number, TriangleMesh& mesh) {
  const auto point = [&](std::size_t i) -> const Vector3& {
    return mesh.vertices[static_cast<std::size_t>(corners[i])];
  };
  std::vector<std::array<int, 3>> triangles = {{0, 1, 2}};
  if (corners.size() > 3) {
    Vector3 normal = Vector3::Zero();
    for (std::size_t i = 2; i < corners.size(); ++i)
      normal += (point(i - 1) - point(0)).cross(point(i) - point(0));
    const Vector3 u = normal.norm() > 0 ? normal.unitOrthogonal() : Vector3::UnitX();
    const Vector3 v = normal.normalized().cross(u);
    std::vector<Vector2> flat;
    Loop loop;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      flat.emplace_back(u.dot(point(i)), v.dot(point(i)));
      loop.push_back(static_cast<int>(i));
    }
    triangles = Triangulated(flat, {loop});
  }
  for (const auto& [a, b, c] : triangles) {
    const auto corner = [&](int i) { return corners[static_cast<std::size_t>(i)]; };
    mesh.triangles.push_back(
        {.corners = {corner(a), corner(b), corner(c)}, .number = number, .line = words.line()});
  }
  if (mesh.triangles.size() > kMostTriangles)
    words.Fail("there are too many triangles", fmt::format("at most {}", kMostTriangles));
}

Loop ReadCorners(TextWords& words, std::size_t vertices) {
  Loop corners;
  for (std::string_view word = words.Word(); !word.empty(); word = words.Word()) {
    corners.push_back(VertexOf(words, word, vertices));
    if (corners.size() > kMostCorners)
      words.Fail("the face has too many corners", fmt::format("at most {}", kMostCorners));
  }
  if (corners.size() < 3)
    words.Fail(fmt::format("the face has {} corners", corners.size()), "at least 3");
  return corners;
}

}  // namespace

TriangleMesh ReadObj(std::string_view text, const std::string& file) {
  TriangleMesh mesh{.file = file, .vertices = {}, .triangles = {}};
  TextWords words(text, file);
  int faces = 0;
  while (words.NextLine()) {
    const std::string_view word = words.Word();
    if (word.empty() || word.starts_with('#')) continue;
    if (word == "v") {
      const double x = words.Number();
      const double y = words.Number();
      mesh.vertices.emplace_back(x, y, words.Number());
    } else if (word == "f") {
      AddFace(words, ReadCorners(words, mesh.vertices.size()), ++faces, mesh);
    } else if (std::ranges::find(kSkipped, word) == kSkipped.end()) {
      words.Fail(Quote(word) + " cannot be read", "vertices (v) and faces (f)");
    }
  }
  return mesh;
}

}  // namespace assay::mesh_import
