#pragma once

#include <optional>
#include <vector>

#include "planner/domain/grasps/round_side.h"
#include "planner/domain/parts/feature.h"
#include "planner/geometry/planar_region.h"

namespace assay::domain {

// Two faces with opposite outward normals, on which pads can close.
struct FacePair {
  FaceId first;
  FaceId second;
  double width = 0;   // metres between them
  Pose X_PartMiddle;  // frame midway; z is the outward normal of the first, x and y are its x and y
  geometry::Patches region;  // points that are on both faces, seen along z
  geometry::Patches walls;   // walls of holes in the planes of the faces, which no pad may touch
};

// Returns the pairs of a part's faces that are at most `widest` metres apart and cover some of each
// other. The region leaves walls of holes out: holes are for other parts, so a hand does not reach
// into them.
std::vector<FacePair> PairsOf(const PartModel& part, double widest);

// Returns the round side of the part that a pair belongs to, with its axis through the middle of
// the pair's region. None if the pair belongs to none.
std::optional<RoundSide> RoundSideOf(const PartModel& part, const FacePair& pair);

}  // namespace assay::domain
