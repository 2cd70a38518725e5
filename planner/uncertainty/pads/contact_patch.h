#pragma once

#include <optional>

#include "planner/domain/parts/part_model.h"
#include "planner/geometry/planar_region.h"
#include "planner/plan/data/plan.h"

namespace assay::uncertainty {

using geometry::Vector2;

// Returns the face that a pad lies on; null if there is none. `side` is 1 or -1 and says on which
// side along the tool's y the pad is.
const domain::Face* FaceAt(const domain::PartModel& model, const plan::Hold& hold, double side);

// Returns the corners of a rectangle about `middle` (x and z of the tool), in the coordinates of a
// face that a pad lies on.
geometry::Polygon OnFaceOf(const domain::Face& face, const plan::Hold& hold, double side,
                           const Vector2& middle, const Vector2& half);

// Returns whether both pads lie wholly on faces. `pad` is half their extents.
bool LieOnFaces(const domain::PartModel& model, const plan::Hold& hold, const Vector2& pad);

// Returns the area, in the tool's x and z, in which the pad on this side touches its face. The area
// is inside the rectangle about the middle of the pads whose half extents are `within`.
geometry::Patches TouchedPatch(const domain::PartModel& model, const plan::Hold& hold, double side,
                               const Vector2& within);

// Returns the area, in the tool's x and z, in which both pads touch a face, opposite each other.
// The area is inside the rectangle about the middle of the pads whose half extents are `within`. If
// the part is displaced along the pads by at most the difference between the pads' half extents and
// `within`, it surely touches with all of this area.
geometry::Patches OppositePatch(const domain::PartModel& model, const plan::Hold& hold,
                                const Vector2& within);

Eigen::AlignedBox2d BoundsOf(const geometry::Patches& patches);

// Returns half the angle between neighbouring faces, in radians, if the pads close on the middle of
// a side that is round about the tool's z. The side must be round along the whole area that the
// pads touch, and within `reach` metres of the pads' middle nothing of the part may stick out of
// this side. Returns none otherwise.
std::optional<double> RoundAboutApproach(const domain::PartModel& model, const plan::Hold& hold,
                                         const Vector2& pad, double reach);

}  // namespace assay::uncertainty
