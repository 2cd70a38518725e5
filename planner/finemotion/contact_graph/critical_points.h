#pragma once

#include <compare>
#include <vector>

#include "planner/finemotion/contacts/polyhedron.h"

namespace assay::finemotion {

// A face of the moving part that lies on a face of the stationary part. The two have an area in
// common.
struct TouchingFaces {
  int moving = 0;  // index into the polyhedron's faces
  int stationary = 0;

  auto operator<=>(const TouchingFaces&) const = default;
};

// A place on the nominal trajectory where the set of touching faces changes (Dakin and Popplestone,
// section 2 and figure 1). Collisions and jamming are likely there.
struct CriticalPoint {
  double travel = 0;  // metres from the trajectory's start
  Pose X_StationaryMoving = Pose::Identity();
  // The faces that touch on the way before this point, ascending; empty at the start.
  std::vector<TouchingFaces> before;
  // The faces that touch on the way after this point. For the end of the trajectory, the faces that
  // touch there.
  std::vector<TouchingFaces> after;
};

// Returns the critical points in the order of travel. The trajectory is the translation along
// `mating_vector` (metres, in the stationary part's axes) that ends at X_StationaryEnd. Faces that
// slide along each other count as touching if the gap between them is at most `play` metres: the
// play that is left in polyhedra without clearance. A round shaft touches a round hole while its
// tip is inside. Faces within a micrometre of one plane count as in it, and places within a
// micrometre of each other count as one.
std::vector<CriticalPoint> CriticalPoints(const Polyhedron& moving, const Polyhedron& stationary,
                                          const Pose& X_StationaryEnd, const Vector3& mating_vector,
                                          double play = 0);

}  // namespace assay::finemotion
