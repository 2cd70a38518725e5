#pragma once

#include <array>
#include <span>
#include <vector>

#include "planner/domain/parts/feature.h"
#include "planner/geometry/box.h"

namespace assay::domain {

// One of the six sides of a box.
struct Side {
  Vector3 normal;     // unit, outward
  double offset = 0;  // normal . p == offset on the side
  std::array<Vector3, 4> corners;
};
std::array<Side, 6> SidesOf(const geometry::Box& box);

// Returns the frame of a part's feature, with its origin at a point and z along a unit vector. Its
// x is the projection of the part's axis that is nearest to perpendicular to z, and the first such
// axis if several are equal. So the part's axes stay visible.
Pose FrameAlong(const Vector3& origin, const Vector3& z);

// Returns the faces of a part: the surface of a union of boxes without what boxes cover of each
// other. There is one Face for each plane and outward normal, in the order of the boxes and their
// sides.
std::vector<Face> ExposedFaces(std::span<const geometry::Box> boxes);

// Returns the face of a part in the plane normal . p == offset with that outward normal. Returns
// None if there is none.
FaceId FindFace(std::span<const Face> faces, const Vector3& normal, double offset);

// Returns the convex hull of points in the plane of a part's face, in the face's x and y.
geometry::Polygon OnFace(const Face& face, std::span<const Vector3> points);

// Returns whether no box of a part reaches into a convex outline on a face, from just inside or
// just outside of the face's plane. Then the mouth of a hole is open.
bool IsOpen(const Face& face, const geometry::Polygon& outline,
            std::span<const geometry::Box> boxes);

}  // namespace assay::domain
