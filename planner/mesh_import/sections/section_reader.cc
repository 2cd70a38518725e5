#include "planner/mesh_import/sections/section_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/geometry/ring.h"
#include "planner/mesh_import/meshes/plane_cut.h"
#include "planner/mesh_import/sections/notches.h"

namespace assay::mesh_import {
namespace {

// How far from the ends of a layer its sections lie, as a share of its thickness.
constexpr double kFromEnd = 1e-5;

double GirthOf(const std::vector<Vector2>& corners) {
  double length = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
    length += (corners[(i + 1) % corners.size()] - corners[i]).norm();
  return length;
}

double Unlikeness(const Column& a, const Column& b) {
  if (a.is_hole != b.is_hole || a.mouth.has_value() != b.mouth.has_value())
    return std::numeric_limits<double>::infinity();
  return (a.at_low.center - b.at_low.center).norm() +
         (a.at_low.Bounds().sizes() - b.at_low.Bounds().sizes()).norm();
}

}  // namespace

Slant SlantOf(const TriangleMesh& mesh, const Triangle& triangle, double tolerance) {
  const Vector3 normal = mesh.AreaVector(triangle);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  double longest = 0;
  for (int k = 0; k < 3; ++k) {
    low = std::min(low, mesh.Corner(triangle, k).z());
    high = std::max(high, mesh.Corner(triangle, k).z());
    longest =
        std::max(longest, (mesh.Corner(triangle, (k + 1) % 3) - mesh.Corner(triangle, k)).norm());
  }
  if (high - low <= tolerance) return Slant::kAcross;
  if (2 * normal.norm() <= tolerance * longest) return Slant::kNone;
  const double shift = (high - low) * std::abs(normal.z());
  return shift <= tolerance * normal.head<2>().norm() ? Slant::kAlong : Slant::kSlanting;
}

std::vector<Level> LevelsOf(const TriangleMesh& mesh, double tolerance) {
  std::vector<double> heights;
  for (const Triangle& triangle : mesh.triangles) {
    const Slant slant = SlantOf(mesh, triangle, tolerance);
    if (slant == Slant::kAlong || slant == Slant::kNone) continue;
    for (int k = 0; k < 3; ++k) heights.push_back(mesh.Corner(triangle, k).z());
  }
  std::ranges::sort(heights);
  std::vector<Level> levels;
  for (const double height : heights) {
    if (levels.empty() || height > levels.back().high + tolerance) {
      levels.push_back({height, height});
    } else {
      levels.back().high = height;
    }
  }
  return levels;
}

std::vector<Column> SectionReader::At(double height) const {
  const Section section =
      SectionOf(mesh_, {.normal = Vector3::UnitZ(), .height = height, .tolerance = 0});
  std::vector<Column> read;
  for (const geometry::Loop& loop : section.loops) {
    if (read.size() > kMostLoops) break;
    std::vector<Vector2> curve;
    for (const int i : loop) curve.push_back(section.points[static_cast<std::size_t>(i)].head<2>());
    Read(curve, read);
  }
  return read;
}

SectionReader::Ends SectionReader::EndsBetween(const Level& below, const Level& above) const {
  const double margin = kFromEnd * (above.low - below.high);
  return {.bottom = At(below.high + margin), .top = At(above.low - margin)};
}

void SectionReader::Read(const std::vector<Vector2>& curve, std::vector<Column>& read) const {
  const double area = geometry::SignedArea(curve);
  std::vector<Vector2> corners = Simplified(curve, rules_.tolerance / 2);
  if (corners.size() < 3 || std::abs(area) <= rules_.tolerance * GirthOf(corners)) return;
  if (area < 0) {
    read.push_back(Hole(corners, {}));
    return;
  }
  for (const Notch& notch : FillNotches(corners, rules_.tolerance))
    read.push_back(Hole(notch.outline, notch.outward));
  Column column;
  column.at_low = FitContour(
      corners, {.tolerance = rules_.tolerance / 2, .most_left_out = rules_.most_left_out});
  read.push_back(std::move(column));
}

// Rounded corners of holes stay, because a hole must not be wider than in the file.
Column SectionReader::Hole(const std::vector<Vector2>& corners,
                           std::optional<Vector2> mouth) const {
  Column column{.is_hole = true};
  column.at_low = FitContour(corners, {.tolerance = rules_.tolerance / 2, .most_left_out = 0});
  column.mouth = mouth;
  return column;
}

std::vector<Column>::iterator MostAlike(const Column& column, std::vector<Column>& section) {
  const auto unlikeness = [&](const Column& other) { return Unlikeness(other, column); };
  const auto match = std::ranges::min_element(section, {}, unlikeness);
  return match == section.end() || std::isinf(unlikeness(*match)) ? section.end() : match;
}

}  // namespace assay::mesh_import
