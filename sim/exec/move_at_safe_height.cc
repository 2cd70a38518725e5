#include "sim/exec/execution.h"
#include "sim/exec/travel.h"

namespace assay::exec {
namespace {

// The corners of the straight lines up to the next travel.
std::vector<Vector3> CornersAfter(std::span<const Command> rest, const Execution& execution) {
  std::vector<Vector3> corners;
  for (const Command& command : rest) {
    if (std::holds_alternative<MoveAtSafeHeight>(command)) break;
    if (const auto* line = std::get_if<MoveStraight>(&command)) {
      corners.push_back(execution.Erring(line->X_WorldTool).translation());
    }
  }
  return corners;
}

}  // namespace

Progress Run(const MoveAtSafeHeight& move, std::span<const Command> rest, Execution& execution) {
  const TravelResult result = PlanTravel(execution.problem(), execution.world(),
                                         {.from = execution.commanded(),
                                          .opening = execution.scene().Opening(execution.data()),
                                          .X_WorldTool = execution.Erring(move.X_WorldTool),
                                          .corners = CornersAfter(rest, execution)});
  if (const auto* why = std::get_if<std::string>(&result)) {
    return Failure{ExecutionOutcome::kUnreachable, *why};
  }
  for (const JointTrajectory& way : std::get<std::vector<JointTrajectory>>(result)) {
    if (Progress failure = execution.Follow(way, way.duration())) return failure;
  }
  return std::nullopt;
}

}  // namespace assay::exec
