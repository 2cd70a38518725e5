#pragma once

#include <span>
#include <vector>

#include "planner/domain/parts/feature.h"
#include "planner/geometry/hull.h"

namespace assay::domain {

// A side of a convex solid.
struct Side {
  Vector3 normal;     // unit, outward
  double offset = 0;  // normal . p == offset on the side
  std::vector<Vector3> corners;
};
// Returns the sides of a solid in the order of geometry::FacetsByAxis.
std::vector<Side> SidesOf(const geometry::ConvexHull& solid);

// Returns the sides of the solids that look along a direction, the outermost first.
std::vector<Side> SidesTowards(std::span<const geometry::ConvexHull> solids,
                               const Vector3& direction);

// Returns the greatest value of direction . p for the points of the solids.
double FarthestAlong(std::span<const geometry::ConvexHull> solids, const Vector3& direction);

// Returns the frame of a part's feature, with its origin at a point and z along a unit vector. Its
// x is the projection of that axis of the part which is nearest to perpendicular to z. If several
// axes are equally near, it is the first of them. The axes of the frame are thus those of the part
// wherever possible.
Pose FrameAlong(const Vector3& origin, const Vector3& z);

// Returns the faces of a part: the surface of a union of convex solids without what solids
// cover of each other. There is one Face for each plane and outward normal, in the order of the
// solids and their sides.
std::vector<Face> ExposedFaces(std::span<const geometry::ConvexHull> solids);

// Returns whether the solids leave some of a side uncovered. The side belongs to one of them.
bool IsExposed(const Side& side, std::span<const geometry::ConvexHull> solids);

// Returns the face of a part in the plane normal . p == offset with that outward normal. Returns
// None if there is none.
FaceId FindFace(std::span<const Face> faces, const Vector3& normal, double offset);

// Returns the exposed face that a side of a solid is part of. Returns None if the side is covered.
FaceId ExposedFaceOf(std::span<const Face> faces, const Side& side);

// Returns the cross-section of a solid at a height above a face, in the face's x and y.
geometry::Polygon CrossSection(const geometry::ConvexHull& solid, const Face& face, double height);

// Returns the convex hull of points in the plane of a part's face, in the face's x and y.
geometry::Polygon OnFace(const Face& face, std::span<const Vector3> points);

// Returns whether no solid of a part reaches into a convex outline on a face, from just inside or
// just outside of the face's plane. Then the mouth of a hole is open.
bool IsOpen(const Face& face, const geometry::Polygon& outline,
            std::span<const geometry::ConvexHull> solids);

}  // namespace assay::domain
