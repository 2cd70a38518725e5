#pragma once

#include <span>
#include <vector>

#include "planner/domain/reachability/reachability.h"

namespace assay::domain {

// Returns the features that the table or other parts touch face to face or cover, in increasing
// number, with the part at X_WorldPart. A part that lies or leans on another one hides features,
// too.
std::vector<FeatureNumber> OccludedFeatures(const Problem& problem, PartId part,
                                            const Pose& X_WorldPart,
                                            std::span<const PlacedPart> others);

// Returns the stable pose that hides the same features as a part that rests on something other than
// the table (Spar, "Stable Poses and Position Classes"). Returns the first of several, and None if
// none does.
StablePoseId PoseThatHides(const PartModel& model, const std::vector<FeatureNumber>& features);

// Sets the features that each part of the problem hides where it is at the start (Part::hidden),
// and the position class that it is then in.
void NoteOcclusions(Problem& problem);

}  // namespace assay::domain
