#pragma once

#include "planner/finemotion/search/fine_motion_plan.h"

namespace assay::finemotion {

// A perturbed approach and a sequence of contact states by which the tip surely comes in, in spite
// of the errors (Dakin and Popplestone, section 4). An A* search finds the sequence for smaller
// errors; then its start is moved so that it absorbs as much as it can. Of several rounds, the plan
// that absorbs most. Contacts are linearized
// anew at the end of every segment, not once at the critical point as in the paper: edges that are
// parallel there are not where the part is tilted, and how it is tilted is what makes the sequence
// certain. What rows leave out can be more than a motion's margin: what is found is therefore
// replayed in exact geometry (exact_replay.h), with errors at the corners and in the middles of the
// faces of the box and with some that are drawn, and absorbs only what none of these contradicts.
// Where nothing is found, all sequences are looked through, beliefs that are alike
// (known_beliefs.h) counting as one; and one is searched for that absorbs some part of the errors,
// to tell what is in the way of more.
FineMotionPlan SearchStrategy(const Passage& passage, const FineMotionErrors& errors,
                              const StrategyOptions& options = {});

}  // namespace assay::finemotion
