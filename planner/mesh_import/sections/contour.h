#pragma once

#include <span>
#include <vector>

#include "planner/geometry/coordinates.h"

namespace assay::mesh_import {

using geometry::Vector2;

// A closed curve of a section that was recognized: a circle, a rectangle with sides along x and y,
// or a polygon. Lengths are in metres.
struct Contour {
  enum class Kind { kCircle, kRectangle, kPolygon };

  Kind kind = Kind::kPolygon;
  std::vector<Vector2> corners;      // counter-clockwise; of a circle: the corners in the file
  Vector2 center = Vector2::Zero();  // of a circle or a rectangle; else the centroid
  double radius = 0;                 // of a circle
  bool is_circle_of_sides = false;   // whether the sides touch the circle, and not the corners
  // A rectangle has sharp corners, even if the corners of the curve are rounded or bevelled. This
  // is the greatest distance of a sharp corner from the curve, in the unit of the curve.
  double left_out = 0;

  bool IsCircle() const { return kind == Kind::kCircle; }
  Eigen::AlignedBox2d Bounds() const;  // of a circle: of the true circle
  double Area() const;
  bool Contains(const Vector2& p) const;
  // Returns the distance of a point from the curve.
  double DistanceTo(const Vector2& p) const;
  // Returns how far the curve is from its centre in a direction, for a curve that is convex.
  double Reach(const Vector2& direction) const;
  // Returns the corners of the contour in order. For a circle it returns `sides` points on the
  // circle.
  std::vector<Vector2> Outline(int sides) const;
};

struct ContourFit {
  double tolerance = 0;      // points of the curve may be off the contour by so much
  double most_left_out = 0;  // greatest permitted Contour::left_out; 0: no corner may be rounded
};

// Recognizes a closed curve, given by its points in either order.
// - Twelve or more corners on a circle are a circle. The circle goes through the corners, unless
//   the distance between opposite sides has at most one decimal in millimetres, and the distance
//   between opposite corners has three or more. In this case the polygon probably surrounds the
//   circle, and the circle touches the sides.
// - Four sides along x and y are a rectangle, if no sharp corner is farther from the curve than
//   ContourFit::most_left_out.
Contour FitContour(std::span<const Vector2> curve, const ContourFit& fit);

// Returns the polygon without corners that are within `tolerance` of the line between their
// neighbours that remain (Ramer 1972, Douglas and Peucker 1973).
std::vector<Vector2> Simplified(std::span<const Vector2> curve, double tolerance);

// Returns whether no point of one contour is farther than `tolerance` from the other.
bool AreEqual(const Contour& a, const Contour& b, double tolerance);

}  // namespace assay::mesh_import
