#pragma once

#include "planner/finemotion/strategy_search/fine_motion_plan.h"

namespace assay::finemotion {

// Searches for a perturbed approach and a sequence of contact states by which the tip surely enters
// in spite of the errors (Dakin and Popplestone, section 4). An A* search finds the sequence for
// smaller errors. Then its start is moved so that it absorbs as much as possible. This is done in
// several rounds, and the plan that absorbs most is returned.
//
// Contacts are linearized anew at the end of each segment, not once at the critical point as in the
// paper. Edges that are parallel at the critical point are not parallel where the part is tilted,
// and the tilt is what makes the sequence certain. Linear rows can leave out more than a motion's
// margin. Each plan is therefore replayed in exact geometry (exact_replay.h). The errors of the
// replays are the corners of the box, the middles of its faces, and drawn errors. The plan absorbs
// only what none of these replays contradicts.
//
// If nothing is found, all sequences are examined, and believed poses that are alike
// (known_poses.h) count as one. After that, the search looks for a sequence that absorbs a part
// of the errors, to report what stands in the way of greater errors.
FineMotionPlan SearchStrategy(const Passage& passage, const FineMotionErrors& errors,
                              const StrategyOptions& options = {});

}  // namespace assay::finemotion
