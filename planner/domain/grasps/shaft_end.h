#pragma once

#include <optional>
#include <vector>

#include "planner/domain/grasps/face_pair.h"
#include "planner/domain/parts/part_model.h"
#include "planner/geometry/coordinates.h"

namespace assay::domain {

// Grasps of a shaft at its end away from the tip. They leave most of the shaft free for its hole.

// Returns unit vectors in the middle plane of a pair of faces, away from the tips of the shafts to
// which both faces belong.
std::vector<Vector2> AwayFromTips(const PartModel& part, const FacePair& pair);

// Returns where the centre of pads can be farther `away` on faces with this outline. The pads end
// kDeepEnough before the end of the faces. Returns none if they cannot be farther than at `center`,
// where their outline is `pad`.
std::optional<Vector2> TowardsEnd(const geometry::Polygon& outline, const geometry::Polygon& pad,
                                  const Vector2& center, const Vector2& away);

}  // namespace assay::domain
