#pragma once

#include <string>
#include <vector>

#include "planner/base/id.h"
#include "planner/geometry/coordinates.h"

namespace assay::domain {

using geometry::Pose;
using geometry::Vector2;
using geometry::Vector3;

// Rounding may change metres, radians and numbers near 1 by at most this.
inline constexpr double kRounding = 1e-9;

using FaceId = Id<struct FaceTag>;
using FeatureNumber = Id<struct FeatureTag>;  // number in the part file

// The whole exposed surface of a part that lies in one plane and has the same outward normal.
struct Face {
  Vector3 normal;                          // unit, outward, part frame
  double offset = 0;                       // normal . p == offset on the face
  Pose X_PartFace;                         // origin on the plane, z = normal
  std::vector<geometry::Polygon> patches;  // in the face's x and y; disjoint, convex

  // Returns whether every point of the polygon (face coordinates, convex) is on the face. This is
  // pad contact.
  bool Covers(const geometry::Polygon& polygon) const;
};

// The mouth of a hole or recess in a face.
struct Mouth {
  FaceId face;
  geometry::Polygon outline;  // in the face's x and y
};

// An inner side of a hole or recess.
struct Wall {
  FaceId face;
  geometry::Polygon outline;  // in the face's x and y
  // True if the wall is set back by the clearance, because the pocket is widened along this axis.
  // The walls of a round pocket go back by less, since their polygon stays within the circle: by
  // the clearance times cos(180 degrees / sides).
  bool moves_with_clearance = false;
};

// A named geometric element, with the number of the part file as in the papers (Spar: surfaces 7
// and 8 of peg and block mate). It is made of faces, or it is a hole.
struct Feature {
  FeatureNumber number;
  std::string description;    // text for people: "square hole"
  std::vector<FaceId> faces;  // empty for a hole
  std::vector<Mouth> mouths;  // a through hole has two
  std::vector<Wall> walls;    // inner sides of a hole, with its floor
  Pose X_PartFeature;         // the mating frame: origin on the axis at the mouth, z along the
                              // axis, outward; of a shaft: at the centre of its tip; of a face:
                              // at its centroid, z = normal
  // Size of the bevelled edges of a hole's mouth or of a shaft's tip, across the axis and along it,
  // in metres. The solids of the part have these bevels.
  double chamfer = 0;

  bool is_plain_face() const { return faces.size() == 1 && mouths.empty(); }
};

}  // namespace assay::domain
