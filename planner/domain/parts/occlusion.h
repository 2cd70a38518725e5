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

// Sets, for each part of the problem at its start, which of its features are hidden (Part::hidden),
// and its position class.
void NoteOcclusions(Problem& problem);

}  // namespace assay::domain
