#include <fmt/format.h>

#include "sim/execution/commands/run.h"
#include "sim/execution/control/hybrid_control.h"

namespace assay::execution {
namespace {

// Returns whether the mating came to an error state that its strategy could not leave.
bool IsErrorState(TrialOutcome outcome) {
  return TrialOutcome::kJammed <= outcome && outcome <= TrialOutcome::kDropped;
}

}  // namespace

Progress Run(const FollowStrategy& follow, std::span<const Command>, Execution& execution) {
  const ControlLaw law;
  const double usual_limit = execution.force_limit();
  execution.LimitForce(law.force_limit);
  HybridControl control(follow.strategy, follow.fixed, law, execution);
  StrategyEnd end = control.Run();
  execution.LimitForce(usual_limit);
  // The servos, which were soft, are stiff again.
  execution.TakeStock();
  if (end.outcome == TrialOutcome::kSucceeded && !execution.IsInHand()) {
    end.outcome = TrialOutcome::kDropped;
    end.reason = "the part is no longer in the hand";
  }
  if (end.outcome == TrialOutcome::kSucceeded) return std::nullopt;
  return Failure{IsErrorState(end.outcome) ? TrialOutcome::kOperatorCalled : end.outcome,
                 fmt::format("{}: {}", Name(end.outcome), end.reason)};
}

Progress Run(const Clamp& clamp, std::span<const Command>, Execution& execution) {
  constexpr double kSettle = 0.1;  // seconds for the part to settle
  execution.scene().Clamp(execution.data(), clamp.part, clamp.force);
  return execution.Stay(kSettle);
}

}  // namespace assay::execution
