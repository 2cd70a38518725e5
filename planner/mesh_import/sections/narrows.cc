#include "planner/mesh_import/sections/narrows.h"

#include <algorithm>

namespace assay::mesh_import {
namespace {

// Returns whether one column begins where the other one ends, at the other one's top or bottom, and
// one of them is around the centre of the other.
bool Adjoins(const Column& other, const Column& column, bool top) {
  if (top ? other.low != column.high : other.high != column.low) return false;
  const Contour& own = column.At(top);
  const Contour& next = other.At(!top);
  return own.Contains(next.center) || next.Contains(own.center);
}

bool DecidesAtEnd(const std::vector<Column>& columns, const Column& column, bool top) {
  bool has_hole = false;
  bool has_outline = false;
  for (const Column& other : columns) {
    if (!Adjoins(other, column, top)) continue;
    (other.is_hole ? has_hole : has_outline) = true;
    const bool is_wider = other.At(!top).Area() > column.At(top).Area();
    if (other.is_hole == column.is_hole && is_wider != column.is_hole) return false;
  }
  // Beside a hole without a next layer there is a floor, unless the body ends there.
  return !column.is_hole || has_hole || !has_outline;
}

}  // namespace

void FillNarrows(std::vector<Column>& columns) {
  std::vector<Column> filled = columns;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const Column& column = columns[i];
    const double radius = column.at_low.radius + (column.is_hole ? -1 : 1) * column.beyond;
    if (!column.is_step || !column.at_low.IsCircle() || radius <= 0 ||
        !DecidesAtEnd(columns, column, false) || !DecidesAtEnd(columns, column, true))
      continue;
    filled[i].is_step = false;
    filled[i].beyond = 0;
    filled[i].at_low.radius = filled[i].at_high.radius = radius;
  }
  columns = std::move(filled);
}

}  // namespace assay::mesh_import
