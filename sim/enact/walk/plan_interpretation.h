#pragma once

#include <memory>

#include "sim/enact/walk/interpretation.h"
#include "sim/enact/walk/planned_worlds.h"

namespace assay::enact {

// What the words of that tree are in the workcell. Actions: a look tells which of the open poses a
// part has, by the camera; steps of plans are executed, verified and recovered from like anywhere
// (exec::StepExecution). Predicates, of the present:
//   pose(part) = p       the part is nearest to that one of the poses that it may have
//   signals(step, e)     what is measured, truly is so
// and of what is done and told, which no audit asks:
//   passed(step)         the verifications that follow the step signalled nothing. Whether the step
//                        went well is not claimed: an opening tells nothing of a part that has
//                        turned between the pads, nor a height of one that leans. If it did not,
//                        later verifications or the goal tell.
Interpretation InterpretationOf(std::shared_ptr<const PlannedWorlds> planned);

inline constexpr double kNear = 0.003;         // metres
inline constexpr double kNearlyTurned = 0.05;  // radians

// Whether the goals of a world's scenario hold in the simulator: matings within kNear, parts in the
// stable poses that are wanted.
bool AreGoalsTrue(const Truth& truth);

}  // namespace assay::enact
