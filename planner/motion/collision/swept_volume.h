#pragma once

#include <optional>
#include <vector>

#include "planner/motion/collision/collision_scene.h"
#include "planner/motion/paths/joint_path.h"

namespace assay::motion {

// A convex piece of the volume where a body was, or may have been.
struct SweptPiece {
  BodyId body;
  geometry::RoundedHull hull;  // in the world
};

struct SweepAccuracy {
  double sagitta = 0.003;  // greatest growth of a piece, metres
  // Share by which a merged piece may be larger than its parts together.
  double added_volume = 0.15;
};

// Returns the volume that the bodies which move with the arm sweep along a path, as convex pieces.
// The pieces contain every point of the bodies at all times. On each step of the path, a piece is
// the hull of the vertices at both ends, grown by the greatest distance of a point from its chord.
// This distance is 1/8 of the point's greatest acceleration if the step takes unit time: the sum
// over joints k, l of turn_k turn_l reach_max(k,l). (For one joint, with delta = turn reach, it is
// the sagitta bound delta^2 / (8 reach).) Steps are so short that the growth is at most `sagitta`.
// Successive pieces of one hull of a body are merged while little volume is added.
std::vector<SweptPiece> SweptVolume(const CollisionScene& scene, const JointPath& path,
                                    const SweepAccuracy& accuracy);

// Returns the first pair of bodies whose distance falls below `clearance` (metres): a piece's own
// body, and a body that stands still and that it must not touch. Returns none if everything that
// moves stays clear. Pieces are never smaller than what they contain. An answer without an
// obstruction is therefore a proof, and an answer with an obstruction is not.
std::optional<BodyPair> InTheWay(const CollisionScene& scene, const std::vector<SweptPiece>& pieces,
                                 double clearance);

// Returns the greatest distance, in metres, of a point of the body from its chord at the same share
// of the way. The motion is straight in joint space, and turns the joints by `turn` (radians, >=
// 0).
double SagittaBound(const Body& body, const JointVector& turn);

}  // namespace assay::motion
