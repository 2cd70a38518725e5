#include "planner/domain/parts/solids/convex_pieces_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "planner/base/input_files/input_error.h"
#include "planner/base/input_files/input_file.h"
#include "planner/geometry/files/obj.h"
#include "planner/geometry/hull.h"

namespace assay::domain {
namespace {

using geometry::Vector3;

constexpr double kThinnestPiece = 1e-5;  // metres
constexpr double kFarthest = 100;        // greatest coordinate, metres
constexpr std::size_t kMostPieces = 1000;
constexpr std::size_t kMostVertices = 1000;  // of one piece

// Returns the vertices of an object in metres.
std::vector<Vector3> VerticesOf(const geometry::ObjText& obj, std::size_t object, double unit,
                                const FilePlace& place) {
  const std::size_t next = object + 1;
  const std::size_t end = next < obj.objects.size() ? obj.objects[next].first : obj.vertices.size();
  std::vector<Vector3> vertices;
  for (std::size_t i = obj.objects[object].first; i < end; ++i)
    vertices.push_back(unit * obj.vertices[i]);
  if (vertices.size() > kMostVertices) {
    throw InputError(place, fmt::format("the object has {} vertices", vertices.size()),
                     fmt::format("at most {}", kMostVertices));
  }
  const auto is_far = [](const Vector3& p) { return p.cwiseAbs().maxCoeff() > kFarthest; };
  if (std::ranges::any_of(vertices, is_far)) {
    throw InputError(place, "a vertex of the object is too far away",
                     fmt::format("coordinates of at most {} m", kFarthest));
  }
  if (!geometry::SpanSpace(vertices, kThinnestPiece)) {
    throw InputError(place, "the vertices of the object lie in one plane",
                     fmt::format("an object that is at least {} m thick", kThinnestPiece));
  }
  return vertices;
}

}  // namespace

std::vector<geometry::ConvexHull> ReadConvexPieces(const std::filesystem::path& file, double unit) {
  const geometry::ObjText obj =
      geometry::ReadObj(ReadInput(file, "an OBJ file of convex pieces"), file.string());
  if (obj.objects.empty() || obj.objects.size() > kMostPieces) {
    throw InputError({file.string()}, fmt::format("the file has {} objects", obj.objects.size()),
                     fmt::format("1 to {} objects, each of them convex", kMostPieces));
  }
  std::vector<geometry::ConvexHull> pieces;
  for (std::size_t i = 0; i < obj.objects.size(); ++i) {
    const FilePlace place = {file.string(), obj.objects[i].line, 1};
    pieces.push_back(geometry::HullOf(VerticesOf(obj, i, unit, place)));
  }
  return pieces;
}

}  // namespace assay::domain
