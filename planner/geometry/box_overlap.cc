#include "planner/geometry/box_overlap.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace assay::geometry {
namespace {

constexpr double kParallelEdges = 1e-9;  // sine of the angle between edges that count as parallel

// Returns half the length of a box's projection onto a unit axis.
double HalfWidth(const Box& box, const Vector3& axis) {
  return (box.X_FrameBox.linear().transpose() * axis).cwiseAbs().dot(box.half_extents);
}

double GapAlong(const Box& a, const Box& b, const Vector3& axis) {
  const double between =
      std::abs(axis.dot(b.X_FrameBox.translation() - a.X_FrameBox.translation()));
  return between - HalfWidth(a, axis) - HalfWidth(b, axis);
}

}  // namespace

double Separation(const Box& a, const Box& b) {
  const Matrix3& R_A = a.X_FrameBox.linear();
  const Matrix3& R_B = b.X_FrameBox.linear();
  double gap = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    gap = std::max({gap, GapAlong(a, b, R_A.col(i)), GapAlong(a, b, R_B.col(i))});
    for (int j = 0; j < 3; ++j) {
      const Vector3 cross = R_A.col(i).cross(R_B.col(j));
      // Parallel edges are skipped, because their common normals are normals of faces.
      if (cross.norm() > kParallelEdges) gap = std::max(gap, GapAlong(a, b, cross.normalized()));
    }
  }
  return gap;
}

double OverlapDepth(std::span<const Box> a, std::span<const Box> b) {
  double depth = 0;
  for (const Box& box_a : a) {
    for (const Box& box_b : b) {
      const Vector3 between = box_b.X_FrameBox.translation() - box_a.X_FrameBox.translation();
      if (between.norm() >= box_a.half_extents.norm() + box_b.half_extents.norm()) continue;
      depth = std::max(depth, -Separation(box_a, box_b));
    }
  }
  return depth;
}

std::vector<Box> Moved(std::span<const Box> boxes, const Pose& X_NewFrame) {
  std::vector<Box> moved;
  moved.reserve(boxes.size());
  for (const Box& box : boxes) moved.push_back(box.Transformed(X_NewFrame));
  return moved;
}

double LowestPoint(std::span<const Box> boxes) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Box& box : boxes) {
    lowest = std::min(lowest, box.X_FrameBox.translation().z() - HalfWidth(box, Vector3::UnitZ()));
  }
  return lowest;
}

}  // namespace assay::geometry
