#include "planner/geometry/files/obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "planner/base/input_files/quotation.h"
#include "planner/base/input_files/text_words.h"

namespace assay::geometry {
namespace {

constexpr std::size_t kMostFaceCorners = 10'000;
constexpr std::array<std::string_view, 11> kSkippedWords = {
    "vn", "vt", "vp", "s", "l", "p", "mg", "usemtl", "mtllib", "lod", "usemap"};

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

void AddFace(TextWords& words, ObjText& obj) {
  ObjFace face = {.first = obj.corners.size(), .count = 0, .line = words.line()};
  for (std::string_view word = words.Word(); !word.empty(); word = words.Word()) {
    obj.corners.push_back(VertexOf(words, word, obj.vertices.size()));
    if (++face.count > kMostFaceCorners)
      words.Fail("the face has too many corners", fmt::format("at most {}", kMostFaceCorners));
  }
  if (face.count < 3) words.Fail(fmt::format("the face has {} corners", face.count), "at least 3");
  obj.faces.push_back(face);
}

}  // namespace

ObjText ReadObj(std::string_view text, const std::string& file) {
  ObjText obj;
  TextWords words(text, file);
  ObjObject object;
  while (words.NextLine()) {
    const std::string_view word = words.Word();
    if (word.empty() || word.starts_with('#')) continue;
    if (word == "v") {
      if (obj.objects.empty() || object.line != obj.objects.back().line) {
        object.first = obj.vertices.size();
        obj.objects.push_back(object);
      }
      const double x = words.Number();
      const double y = words.Number();
      obj.vertices.emplace_back(x, y, words.Number());
    } else if (word == "f") {
      AddFace(words, obj);
    } else if (word == "o" || word == "g") {
      object.line = words.line();
    } else if (std::ranges::find(kSkippedWords, word) == kSkippedWords.end()) {
      words.Fail(Quote(word) + " cannot be read", "vertices (v) and faces (f)");
    }
  }
  return obj;
}

}  // namespace assay::geometry
