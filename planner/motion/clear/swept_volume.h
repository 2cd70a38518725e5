#pragma once

#include <optional>
#include <vector>

#include "planner/motion/clear/collision_scene.h"
#include "planner/motion/path/joint_path.h"

namespace assay::motion {

// A convex piece of where a body was, or may have been.
struct SweptPiece {
  BodyId body;
  geometry::RoundedHull hull;  // in the world
};

struct SweepAccuracy {
  double sagitta = 0.003;      // greatest growth of a piece, metres
  double added_volume = 0.15;  // share by which merged pieces may be larger than these together
};

// All that the bodies which move with the arm go through along a path, as convex pieces: none of
// their points is ever outside. On each step a piece is the hull of the vertices at both ends,
// grown by what a point can leave its chord: 1/8 of its greatest acceleration while the step is
// gone in unit time, sum over joints k, l of turn_k turn_l reach_max(k,l) (of one joint, with
// delta = turn reach, the sagitta bound delta^2 / (8 reach)). Steps are so short that this is at
// most `sagitta`. Pieces of a body's hull that follow each other are merged while little volume is
// added.
std::vector<SweptPiece> SweptVolume(const CollisionScene& scene, const JointPath& path,
                                    const SweepAccuracy& accuracy);

// The first piece that comes within `clearance` (metres) of a body that stands and that its own
// body must not touch, and the two; none if what moves stays clear of all that stands. Pieces are
// never smaller than what they hold, so that this is proved, and their being in the way is not.
std::optional<BodyPair> InTheWay(const CollisionScene& scene, const std::vector<SweptPiece>& pieces,
                                 double clearance);

// How far a point of the body can be from its chord, at the same share of the way, on a motion
// straight in joint space that turns the joints by so much (radians, >= 0); metres.
double SagittaBound(const Body& body, const JointVector& turn);

}  // namespace assay::motion
