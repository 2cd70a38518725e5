#include <fmt/format.h>

#include "sim/execution/commands/run.h"
#include "sim/execution/control/straight_line.h"

namespace assay::execution {

Progress Run(const MoveStraight& move, std::span<const Command>, Execution& execution) {
  const domain::Workcell& workcell = *execution.problem().workcell;
  const Vector3 start = ToolAt(workcell, execution.commanded()).translation();
  const Vector3 end = execution.Erring(move.X_WorldTool).translation();
  const LineResult line = FollowLine(workcell, execution.commanded(), end);
  if (!line.path) {
    const Vector3 p = 1e3 * line.stuck_at;
    return Failure{TrialOutcome::kUnreachable,
                   fmt::format("the arm cannot follow the straight line through ({:.1f}, {:.1f}, "
                               "{:.1f}) mm in its present configuration",
                               p.x(), p.y(), p.z())};
  }
  const JointTrajectory timed = WithTimes(*line.path, move.pace, motion::RatesOf(workcell));
  if (!move.guard) return execution.Follow(timed);
  return execution.Follow(timed, {move.guard->force, (end - start).normalized()});
}

}  // namespace assay::execution
