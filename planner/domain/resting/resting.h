#pragma once

#include <span>

#include "planner/domain/parts/placed_part.h"

namespace assay::domain {

// Returns the shadow of a part on the table: the hull of its vertices in world x and y.
geometry::Polygon Footprint(const Part& part, const Pose& X_WorldPart);
// Returns the height of the part's lowest point above the table, in metres.
double LowestPoint(const Part& part, const Pose& X_WorldPart);

// Returns whether a part at X_WorldPart has its whole footprint over the table.
bool IsOver(const Table& table, const Part& part, const Pose& X_WorldPart);
// Returns the table under a resting part: the table that the part is over, or the first table if
// the part is over none.
const Table& TableUnder(const Workcell& workcell, const Part& part, const Pose& X_WorldPart);
// Returns whether the part's whole footprint is on one of the workcell's tables.
bool OnTable(const Problem& problem, PartId part, const Pose& X_WorldPart);

// Returns the first of `others` whose footprint is nearer than the workcell's part gap. Returns
// None if all are far enough.
PartId Crowding(const Problem& problem, PartId part, const Pose& X_WorldPart,
                std::span<const PlacedPart> others);

// Returns the stable pose of a part that rests at X_WorldPart, to within a degree and a millimetre
// of height. Returns None if the part rests in no stable pose (it leans on something).
StablePoseId StablePoseAt(const Part& part, const Pose& X_WorldPart);

// Returns the pose that a part at X_WorldPart has after it has come to rest in the given stable
// pose, which must be near: turned about a level axis through its origin, and at the height of the
// table.
Pose ComeToRest(const Part& part, StablePoseId resting, const Pose& X_WorldPart);

}  // namespace assay::domain
