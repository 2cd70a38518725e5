#include "planner/mesh_import/sections/columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "planner/mesh_import/sections/section_reader.h"

namespace assay::mesh_import {
namespace {

constexpr std::size_t kMostLevels = 80;

bool Continues(const Column& earlier, const Column& column, double tolerance) {
  if (earlier.high != column.low || earlier.is_hole != column.is_hole ||
      earlier.is_straight != column.is_straight || earlier.is_step != column.is_step ||
      earlier.mouth.has_value() != column.mouth.has_value() ||
      !AreEqual(earlier.at_high, column.at_low, 2 * tolerance))
    return false;
  if (earlier.is_straight) return true;
  if (!earlier.at_low.IsCircle() || !column.at_low.IsCircle()) return false;
  // Cones with one slope are one cone.
  const double slope =
      (earlier.at_high.radius - earlier.at_low.radius) / (earlier.high - earlier.low);
  const double expected = earlier.at_high.radius + slope * (column.high - column.low);
  return std::abs(expected - column.at_high.radius) <= 2 * tolerance;
}

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
    auto [bottom, top] = reader_.EndsBetween(below, above);
    LayerColumns layer = ColumnsOfLayer(std::move(bottom), std::move(top), rules_.tolerance);
    if (!layer.reason.empty()) {
      Fail(layer.reason, (below.high + above.low) / 2);
      return false;
    }
    for (Column& column : layer.columns) {
      column.low = below.Middle();
      column.high = above.Middle();
      Append(result_.columns, std::move(column), rules_.tolerance);
    }
    return true;
  }

  const TriangleMesh& mesh_;
  const ColumnRules rules_;
  const SectionReader reader_;
  Columns result_;
};

}  // namespace

LayerColumns ColumnsOfLayer(std::vector<Column> bottom, std::vector<Column> top, double tolerance) {
  if (bottom.size() != top.size() || bottom.size() > SectionReader::kMostLoops) {
    return {
        .columns = {},
        .reason = fmt::format("its section has {} curves at one end of a layer and {} at the other",
                              bottom.size(), top.size())};
  }
  for (Column& column : bottom) {
    const auto match = MostAlike(column, top);
    if (match == top.end())
      return {.columns = {},
              .reason = "a hole of its section becomes an outline between two levels"};
    column.is_straight = AreEqual(column.at_low, match->at_low, tolerance);
    column.at_high = column.is_straight ? column.at_low : match->at_low;
    if (!column.is_straight && column.at_low.IsCircle() != column.at_high.IsCircle())
      return {.columns = {}, .reason = "its section changes its shape between two levels"};
    top.erase(match);
  }
  return {.columns = std::move(bottom), .reason = {}};
}

void Append(std::vector<Column>& columns, Column column, double tolerance) {
  const auto earlier = std::ranges::find_if(
      columns, [&](const Column& other) { return Continues(other, column, tolerance); });
  if (earlier == columns.end()) {
    columns.push_back(std::move(column));
  } else {
    earlier->high = column.high;
    earlier->beyond = std::max(earlier->beyond, column.beyond);
    earlier->at_high = earlier->is_straight ? earlier->at_low : column.at_high;
  }
}

Columns ColumnsOf(const TriangleMesh& mesh, const ColumnRules& rules) {
  return ColumnBuilder(mesh, rules).Build();
}

}  // namespace assay::mesh_import
