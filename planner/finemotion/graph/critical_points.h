#pragma once

#include <compare>
#include <vector>

#include "planner/finemotion/contacts/polyhedron.h"

namespace assay::finemotion {

// A face of the moving part that lies on one of the stationary part, with an area in common.
struct TouchingFaces {
  int moving = 0;  // indices into the polyhedra's faces
  int stationary = 0;

  auto operator<=>(const TouchingFaces&) const = default;
};

// A place on the nominal trajectory where the set of touching faces changes (Dakin and Popplestone,
// section 2 and figure 1): there collisions and jamming are likely.
struct CriticalPoint {
  double travel = 0;  // from the trajectory's start, metres
  Pose X_StationaryMoving = Pose::Identity();
  std::vector<TouchingFaces> before;  // on the way to it, ascending; none at the start
  std::vector<TouchingFaces> after;   // on the way from it; at the end, those that touch there
};

// Of the translation along `mating_vector` (stationary part's axes, metres) that ends at
// X_StationaryEnd, in the order of travel. The polyhedra are those without clearance, so that they
// touch while they slide. Faces nearer than `tolerance` (metres) to one plane are in it, and places
// that are no further apart are one.
std::vector<CriticalPoint> CriticalPoints(const Polyhedron& moving, const Polyhedron& stationary,
                                          const Pose& X_StationaryEnd, const Vector3& mating_vector,
                                          double tolerance = 1e-6);

}  // namespace assay::finemotion
