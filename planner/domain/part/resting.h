#pragma once

#include <span>

#include "planner/domain/part/placed_part.h"

namespace assay::domain {

// The shadow of a part on the table: the hull of its vertices in world x and y.
geometry::Polygon Footprint(const Part& part, const Pose& X_WorldPart);

// Whether a part at X_WorldPart has its whole footprint over the table.
bool IsOver(const Table& table, const Part& part, const Pose& X_WorldPart);
// The table that a part is over; the first if it is over none.
const Table& TableUnder(const Workcell& workcell, const Part& part, const Pose& X_WorldPart);
// Whether its whole footprint is on one of the workcell's tables.
bool OnTable(const Problem& problem, PartId part, const Pose& X_WorldPart);

// The first of `others` whose footprint is nearer than the workcell's part gap; None if all are
// far enough.
PartId Crowding(const Problem& problem, PartId part, const Pose& X_WorldPart,
                std::span<const PlacedPart> others);

// The stable pose of a part that rests at X_WorldPart, to within a degree and a millimetre of
// height; None if it rests in none (it leans on something).
StablePoseId StablePoseAt(const Part& part, const Pose& X_WorldPart);

// X_WorldPart as it is once the part has come to rest in that stable pose, to which it is near:
// turned about a level axis through its origin, and at the height of the table.
Pose ComeToRest(const Part& part, StablePoseId resting, const Pose& X_WorldPart);

}  // namespace assay::domain
