#include "sim/execution/commands/travel.h"

#include "sim/execution/commands/run.h"

namespace assay::execution {
namespace {

// Returns the corners of the straight lines up to the next travel.
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

motion::TravelRequest RequestFor(const MoveAtSafeHeight& move, std::span<const Command> rest,
                                 const Execution& execution) {
  return {.from = execution.commanded(),
          .X_WorldTool = execution.Erring(move.X_WorldTool),
          .corners = CornersAfter(rest, execution)};
}

Progress Go(const motion::TravelResult& travel, Execution& execution) {
  if (const auto* why = std::get_if<std::string>(&travel)) {
    return Failure{TrialOutcome::kUnreachable, *why};
  }
  const auto& path = std::get<motion::JointPath>(travel);
  const motion::JointRates rates = motion::RatesOf(*execution.problem().workcell);
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const JointTrajectory way = motion::SynchronizedMove(path[i], path[i + 1], rates);
    if (Progress failure = execution.Follow(way)) return failure;
  }
  return std::nullopt;
}

Progress Run(const MoveAtSafeHeight& move, std::span<const Command> rest, Execution& execution) {
  return Go(motion::PlanTravel(execution.problem(), execution.BelievedSurroundings(),
                               RequestFor(move, rest, execution)),
            execution);
}

}  // namespace assay::execution
