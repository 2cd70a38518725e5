#pragma once

#include <span>
#include <vector>

#include "planner/domain/reach/reachability.h"

namespace assay::domain {

// The features that the table or other parts touch face to face or cover, in increasing number,
// with the part at X_WorldPart: what a part hides that lies or leans on another one.
std::vector<FeatureNumber> OccludedFeatures(const Problem& problem, PartId part,
                                            const Pose& X_WorldPart,
                                            std::span<const PlacedPart> others);

// For a part that rests on something else than the table: the stable pose that hides the same
// features (Spar, "Stable Poses and Position Classes"), the first of several; None if none does.
StablePoseId PoseThatHides(const PartModel& model, const std::vector<FeatureNumber>& features);

// Sets what each part of the problem hides where it is at the start (Part::hidden), and the
// position class that it is then in.
void NoteOcclusions(Problem& problem);

}  // namespace assay::domain
