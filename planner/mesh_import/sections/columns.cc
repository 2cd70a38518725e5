#include "planner/mesh_import/sections/columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/geometry/ring.h"
#include "planner/mesh_import/meshes/plane_cut.h"
#include "planner/mesh_import/sections/notches.h"

namespace assay::mesh_import {
namespace {

constexpr std::size_t kMostLevels = 80;
constexpr std::size_t kMostLoops = 200;  // of one section
// How far from the ends of a layer its sections lie, as a share of its thickness.
constexpr double kFromEnd = 1e-5;

// A range of heights that count as one level.
struct Level {
  double low = 0;
  double high = 0;
  double Middle() const { return (low + high) / 2; }
};

enum class Slant { kAlong, kAcross, kSlanting, kNone };

// Returns how a triangle lies to the axis. A triangle without width counts as none.
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

// Reads the section of a mesh at one height.
class SectionReader {
 public:
  SectionReader(const TriangleMesh& mesh, const ColumnRules& rules) : mesh_(mesh), rules_(rules) {}

  std::vector<Column> At(double height) const {
    const Section section =
        SectionOf(mesh_, {.normal = Vector3::UnitZ(), .height = height, .tolerance = 0});
    std::vector<Column> read;
    for (const geometry::Loop& loop : section.loops) {
      if (read.size() > kMostLoops) break;
      std::vector<Vector2> curve;
      for (const int i : loop)
        curve.push_back(section.points[static_cast<std::size_t>(i)].head<2>());
      Read(curve, read);
    }
    return read;
  }

 private:
  void Read(const std::vector<Vector2>& curve, std::vector<Column>& read) const {
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
  Column Hole(const std::vector<Vector2>& corners, std::optional<Vector2> mouth) const {
    Column column{.is_hole = true};
    column.at_low = FitContour(corners, {.tolerance = rules_.tolerance / 2, .most_left_out = 0});
    column.mouth = mouth;
    return column;
  }

  static double GirthOf(const std::vector<Vector2>& corners) {
    double length = 0;
    for (std::size_t i = 0; i < corners.size(); ++i)
      length += (corners[(i + 1) % corners.size()] - corners[i]).norm();
    return length;
  }

  const TriangleMesh& mesh_;
  const ColumnRules& rules_;
};

double Unlikeness(const Contour& a, const Contour& b) {
  return (a.center - b.center).norm() + (a.Bounds().sizes() - b.Bounds().sizes()).norm();
}

bool CanTaper(const Contour& a, const Contour& b) { return a.IsCircle() == b.IsCircle(); }

// Builds the columns layer by layer.
class ColumnBuilder {
 public:
  ColumnBuilder(const TriangleMesh& mesh, const ColumnRules& rules)
      : mesh_(mesh), rules_(rules), reader_(mesh, rules) {}

  Columns Build() {
    const std::vector<Level> levels = LevelsOf(mesh_, rules_.tolerance);
    if (levels.size() < 2) {
      Fail("it has no ends across the axis", 0);
    } else if (levels.size() > kMostLevels) {
      Fail(fmt::format("its section changes at {} heights", levels.size()),
           levels[levels.size() / 2].low);
    } else {
      for (std::size_t i = 1; i < levels.size() && AddLayer(levels[i - 1], levels[i]); ++i) {
      }
    }
    return std::move(result_);
  }

 private:
  // Notes why the mesh is no stack, with the slanting triangle that is nearest to a height.
  void Fail(const std::string& reason, double height) {
    result_.reason = reason;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
      const double off = std::abs(mesh_.Centroid(mesh_.triangles[i]).z() - height);
      if (SlantOf(mesh_, mesh_.triangles[i], rules_.tolerance) != Slant::kSlanting || off >= least)
        continue;
      least = off;
      result_.triangle = static_cast<int>(i);
    }
  }

  bool AddLayer(const Level& below, const Level& above) {
    const double margin = kFromEnd * (above.low - below.high);
    std::vector<Column> bottom = reader_.At(below.high + margin);
    std::vector<Column> top = reader_.At(above.low - margin);
    const double middle = (below.high + above.low) / 2;
    if (bottom.size() != top.size() || bottom.size() > kMostLoops) {
      Fail(fmt::format("its section has {} curves at one end of a layer and {} at the other",
                       bottom.size(), top.size()),
           middle);
      return false;
    }
    for (Column& column : bottom) {
      const auto unlikeness = [&](const Column& other) {
        const bool is_alike =
            other.is_hole == column.is_hole && other.mouth.has_value() == column.mouth.has_value();
        return is_alike ? Unlikeness(other.at_low, column.at_low)
                        : std::numeric_limits<double>::infinity();
      };
      const auto match = std::ranges::min_element(top, {}, unlikeness);
      if (std::isinf(unlikeness(*match))) {
        Fail("a hole of its section becomes an outline between two levels", middle);
        return false;
      }
      column.low = below.Middle();
      column.high = above.Middle();
      column.at_high = match->at_low;
      column.is_straight = AreEqual(column.at_low, column.at_high, rules_.tolerance);
      if (!column.is_straight && !CanTaper(column.at_low, column.at_high)) {
        Fail("its section changes its shape between two levels", middle);
        return false;
      }
      if (column.is_straight) column.at_high = column.at_low;
      top.erase(match);
      Append(std::move(column));
    }
    return true;
  }

  // Lengthens a column that the new one continues, or adds the new one.
  void Append(Column column) {
    for (Column& earlier : result_.columns) {
      if (earlier.high != column.low || earlier.is_hole != column.is_hole ||
          earlier.is_straight != column.is_straight ||
          earlier.mouth.has_value() != column.mouth.has_value() || !Continues(earlier, column))
        continue;
      earlier.high = column.high;
      earlier.at_high = earlier.is_straight ? earlier.at_low : column.at_high;
      return;
    }
    result_.columns.push_back(std::move(column));
  }

  bool Continues(const Column& earlier, const Column& column) const {
    if (!AreEqual(earlier.at_high, column.at_low, 2 * rules_.tolerance)) return false;
    if (earlier.is_straight) return true;
    if (!earlier.at_low.IsCircle() || !column.at_low.IsCircle()) return false;
    // Cones with one slope are one cone.
    const double slope =
        (earlier.at_high.radius - earlier.at_low.radius) / (earlier.high - earlier.low);
    const double expected = earlier.at_high.radius + slope * (column.high - column.low);
    return std::abs(expected - column.at_high.radius) <= 2 * rules_.tolerance;
  }

  const TriangleMesh& mesh_;
  const ColumnRules rules_;
  const SectionReader reader_;
  Columns result_;
};

}  // namespace

Columns ColumnsOf(const TriangleMesh& mesh, const ColumnRules& rules) {
  return ColumnBuilder(mesh, rules).Build();
}

}  // namespace assay::mesh_import
