#include "planner/mesh_import/files/stl.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "planner/base/input_files/input_error.h"
#include "planner/base/input_files/quotation.h"
#include "planner/base/input_files/text_words.h"

namespace assay::mesh_import {
namespace {

constexpr std::size_t kHeadBytes = 84;
constexpr std::size_t kTriangleBytes = 50;
constexpr std::size_t kNormalBytes = 12;  // the normal comes first and is not used
constexpr double kGreatestCoordinate = 1e6;

std::size_t CountIn(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kHeadBytes - sizeof(count), sizeof(count));
  return count;
}

void AddTriangle(TriangleMesh& mesh, int line) {
  const int last = static_cast<int>(mesh.vertices.size());
  mesh.triangles.push_back({.corners = {last - 3, last - 2, last - 1},
                            .number = static_cast<int>(mesh.triangles.size()) + 1,
                            .line = line});
  if (mesh.triangles.size() > kMostTriangles) {
    Refuse(mesh, mesh.triangles.back(), "there are too many triangles",
           fmt::format("at most {}", kMostTriangles));
  }
}

TriangleMesh ReadBinary(std::string_view bytes, const std::string& file) {
  TriangleMesh mesh{.file = file, .vertices = {}, .triangles = {}};
  const std::size_t count = CountIn(bytes);
  for (std::size_t i = 0; i < count; ++i) {
    const char* at = bytes.data() + kHeadBytes + i * kTriangleBytes + kNormalBytes;
    for (int corner = 0; corner < 3; ++corner, at += 3 * sizeof(float)) {
      std::array<float, 3> p;
      std::memcpy(p.data(), at, sizeof(p));
      mesh.vertices.emplace_back(p[0], p[1], p[2]);
    }
    AddTriangle(mesh, 0);
    for (int k = 0; k < 3; ++k) {
      if (!(mesh.Corner(mesh.triangles.back(), k).lpNorm<Eigen::Infinity>() <= kGreatestCoordinate))
        Refuse(mesh, mesh.triangles.back(), "a coordinate is no number, or too great",
               "numbers of at most a million");
    }
  }
  return mesh;
}

bool IsWord(std::string_view word, std::string_view expected) {
  return std::ranges::equal(word, expected, [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == b;
  });
}

void Expect(TextWords& words, std::string_view expected) {
  const std::string_view word = words.WordOfAnyLine();
  if (IsWord(word, expected)) return;
  words.Fail(word.empty() ? "the file ends early" : Quote(word) + " is out of place",
             Quote(expected));
}

void ReadFacet(TextWords& words, TriangleMesh& mesh) {
  const int line = words.line();
  Expect(words, "normal");
  for (int i = 0; i < 3; ++i) words.Word();  // the normal is not used
  Expect(words, "outer");
  Expect(words, "loop");
  for (int corner = 0; corner < 3; ++corner) {
    Expect(words, "vertex");
    const double x = words.Number();
    const double y = words.Number();
    mesh.vertices.emplace_back(x, y, words.Number());
  }
  Expect(words, "endloop");
  Expect(words, "endfacet");
  AddTriangle(mesh, line);
}

TriangleMesh ReadText(std::string_view text, const std::string& file) {
  TriangleMesh mesh{.file = file, .vertices = {}, .triangles = {}};
  TextWords words(text, file);
  for (std::string_view word = words.WordOfAnyLine(); !word.empty(); word = words.WordOfAnyLine()) {
    if (IsWord(word, "facet")) {
      ReadFacet(words, mesh);
    } else if (IsWord(word, "solid") || IsWord(word, "endsolid")) {
      words.NextLine();  // a name may follow
    } else {
      words.Fail(Quote(word) + " is out of place", "facet, solid or endsolid");
    }
  }
  return mesh;
}

}  // namespace

TriangleMesh ReadStl(std::string_view text, const std::string& file) {
  if (text.size() >= kHeadBytes && text.size() == kHeadBytes + kTriangleBytes * CountIn(text))
    return ReadBinary(text, file);
  const std::size_t begin = std::min(text.find_first_not_of(" \t\r\n"), text.size());
  if (IsWord(text.substr(begin, 5), "solid")) return ReadText(text, file);
  if (text.size() < kHeadBytes) throw InputError({file}, "it is too short", "an STL file");
  throw InputError({file},
                   fmt::format("it has {} bytes, but its head promises {} triangles", text.size(),
                               CountIn(text)),
                   fmt::format("{} bytes, or text that begins with solid",
                               kHeadBytes + kTriangleBytes * CountIn(text)));
}

}  // namespace assay::mesh_import
