#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planner/domain/parts/feature.h"
#include "planner/domain/parts/part_model.h"
#include "planner/domain/parts/solids/part_solids.h"

namespace assay::domain {

// A pocket and the solid that it is cut from, in the part frame. The solids of the part must
// outlive the hollow.
struct Hollow {
  const PartSolids::Solid& solid;
  const PartSolids::Pocket& pocket;
  std::vector<geometry::ConvexHull> clipped;  // the part of the pocket in the solid
};
Hollow HollowOf(const PartSolids& solids, const PartSolids::Pocket& pocket);

// Returns where the first pocket opens in a direction, if the other pockets leave it open. It opens
// to the outside, or into a wider pocket. Returns none if the pockets do not all end in one plane,
// or if the mouth is covered.
std::optional<Mouth> FindMouth(const PartModel& model, std::span<const Hollow> hollows,
                               const Vector3& direction);
// Returns the centre of the pocket in the plane of the face in which it opens.
Vector3 CenterAt(const Face& face, const Hollow& hollow);

// Returns the exposed sides of a pocket, seen from within it.
std::vector<Wall> WallsOf(const PartModel& model, const Hollow& hollow);

}  // namespace assay::domain
