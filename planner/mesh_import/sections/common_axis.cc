#include "planner/mesh_import/sections/common_axis.h"

#include <algorithm>
#include <functional>

namespace assay::mesh_import {
namespace {

void MoveTo(const Vector2& axis, bool is_hole, Contour& circle) {
  const Vector2 way = axis - circle.center;
  circle.radius += (is_hole ? -1 : 1) * way.norm();
  circle.center = axis;
  for (Vector2& corner : circle.corners) corner += way;
}

}  // namespace

void GiveCommonAxes(std::vector<Column>& columns, double tolerance) {
  std::vector<Column*> round;
  for (Column& column : columns) {
    if (column.at_low.IsCircle() && column.at_high.IsCircle()) round.push_back(&column);
  }
  std::ranges::stable_sort(round, std::ranges::greater(),
                           [](const Column* column) { return column->high - column->low; });
  std::vector<Vector2> axes;
  for (Column* column : round) {
    for (Contour* circle : {&column->at_low, &column->at_high}) {
      const auto axis = std::ranges::find_if(
          axes, [&](const Vector2& known) { return (known - circle->center).norm() <= tolerance; });
      if (axis == axes.end()) {
        axes.push_back(circle->center);
      } else {
        MoveTo(*axis, column->is_hole, *circle);
      }
    }
  }
}

}  // namespace assay::mesh_import
