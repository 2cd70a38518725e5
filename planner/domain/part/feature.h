#pragma once

#include <string>
#include <vector>

#include "planner/base/id.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/pose.h"

namespace assay::domain {

using geometry::Pose;
using geometry::Vector2;
using geometry::Vector3;

// By how much rounding may change metres, radians and numbers near 1.
inline constexpr double kRounding = 1e-9;

using FaceId = Id<struct FaceTag>;
using FeatureNumber = Id<struct FeatureTag>;  // as the part file numbers it

// All exposed surface of a part that lies in one plane and looks the same way.
struct Face {
  Vector3 normal;                          // unit, outward, part frame
  double offset = 0;                       // normal . p == offset on the face
  Pose X_PartFace;                         // origin on the plane, z = normal
  std::vector<geometry::Polygon> patches;  // in the face's x and y; disjoint, convex

  // Whether every point of the polygon (face coordinates, convex) is on the face: pad contact.
  bool Covers(const geometry::Polygon& polygon) const;
};

// A hole or recess that opens in a face: where its mouth is.
struct Mouth {
  FaceId face;
  geometry::Polygon outline;  // in the face's x and y
};

// An inner side of a hole or recess.
struct Wall {
  FaceId face;
  geometry::Polygon outline;  // in the face's x and y
  // Whether a greater clearance sets it back by as much: the pocket is widened along this axis.
  bool moves_with_clearance = false;
};

// A named geometric element, numbered by the part file as the papers do (Spar: surfaces 7 and 8
// of peg and block mate). It is made of faces, or it is a hole.
struct Feature {
  FeatureNumber number;
  std::string description;    // "square hole", for people
  std::vector<FaceId> faces;  // empty for a hole
  std::vector<Mouth> mouths;  // a through hole has two
  std::vector<Wall> walls;    // of a hole, its floor included
  Pose X_PartFeature;         // the mating frame: origin on the axis at the mouth, z along the
                              // axis, outward; of a shaft: at the centre of its tip; of a face:
                              // at its centroid, z = normal
  // Of a hole's mouth or of a shaft's tip: how far its edges are bevelled, across the axis and
  // along it, metres. The boxes do not show it.
  double chamfer = 0;

  bool is_plain_face() const { return faces.size() == 1 && mouths.empty(); }
};

}  // namespace assay::domain
