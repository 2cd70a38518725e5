#include "planner/domain/parts/convex_pieces_file.h"

#include <fmt/format.h>

#include <cmath>
#include <sstream>
#include <string>

#include "planner/base/input_files/input_error.h"
#include "planner/base/input_files/input_file.h"
#include "planner/geometry/hull.h"

namespace assay::domain {
namespace {

using geometry::Vector3;

constexpr double kThinnestPiece = 1e-5;  // metres
constexpr double kFarthest = 100;        // greatest coordinate, metres
constexpr std::size_t kMostPieces = 1000;
constexpr std::size_t kMostVertices = 1000;  // of one piece

// The vertices of one object, and the line in which it begins.
struct Cloud {
  int line = 1;
  std::vector<Vector3> vertices;
};

Vector3 ReadVertex(std::istringstream& words, double unit, const FilePlace& place) {
  Vector3 vertex;
  for (int axis = 0; axis < 3; ++axis) {
    double number = 0;
    if (!(words >> number) || !std::isfinite(number) || std::abs(number * unit) > kFarthest) {
      throw InputError(place, "the vertex has no three usable coordinates",
                       fmt::format("three numbers, each at most {} m", kFarthest));
    }
    vertex[axis] = number * unit;
  }
  return vertex;
}

std::vector<Cloud> ReadClouds(const std::filesystem::path& file, double unit) {
  std::istringstream lines(ReadInput(file, "an OBJ file of convex pieces"));
  std::vector<Cloud> clouds(1);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "o" || kind == "g") {
      if (!clouds.back().vertices.empty()) clouds.emplace_back();
      clouds.back().line = number;
    } else if (kind == "v") {
      clouds.back().vertices.push_back(ReadVertex(words, unit, {file.string(), number, 1}));
    }
  }
  if (clouds.back().vertices.empty()) clouds.pop_back();
  return clouds;
}

}  // namespace

std::vector<geometry::ConvexHull> ReadConvexPieces(const std::filesystem::path& file, double unit) {
  std::vector<geometry::ConvexHull> pieces;
  const std::vector<Cloud> clouds = ReadClouds(file, unit);
  if (clouds.empty() || clouds.size() > kMostPieces) {
    throw InputError({file.string()}, fmt::format("the file has {} objects", clouds.size()),
                     fmt::format("1 to {} objects, each of them convex", kMostPieces));
  }
  for (const Cloud& cloud : clouds) {
    const FilePlace place = {file.string(), cloud.line, 1};
    if (cloud.vertices.size() > kMostVertices) {
      throw InputError(place, fmt::format("the object has {} vertices", cloud.vertices.size()),
                       fmt::format("at most {}", kMostVertices));
    }
    if (!geometry::SpanSpace(cloud.vertices, kThinnestPiece)) {
      throw InputError(place, "the vertices of the object lie in one plane",
                       fmt::format("an object that is at least {} m thick", kThinnestPiece));
    }
    pieces.push_back(geometry::HullOf(cloud.vertices));
  }
  return pieces;
}

}  // namespace assay::domain
