#include <fmt/format.h>

#include "sim/execution/control/hybrid_control.h"
#include "sim/execution/robots/execution.h"

namespace assay::execution {
namespace {

// Returns the executor's outcome for an outcome of the mating. Details that only the mating has are
// in the reason.
TrialOutcome TrialOutcomeOf(MatingOutcome outcome) {
  switch (outcome) {
    case MatingOutcome::kDone:
      return TrialOutcome::kSucceeded;
    case MatingOutcome::kJammed:
    case MatingOutcome::kWedged:
    case MatingOutcome::kWrongContact:
    case MatingOutcome::kTimeout:
    case MatingOutcome::kDropped:
      return TrialOutcome::kOperatorCalled;
    case MatingOutcome::kOverload:
      return TrialOutcome::kOverload;
    case MatingOutcome::kUnreachable:
      return TrialOutcome::kUnreachable;
    case MatingOutcome::kEngineWarning:
      return TrialOutcome::kEngineWarning;
  }
  return TrialOutcome::kOperatorCalled;
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
  if (end.outcome == MatingOutcome::kDone && !execution.IsInHand()) {
    end.outcome = MatingOutcome::kDropped;
    end.reason = "the part is no longer in the hand";
  }
  if (end.outcome == MatingOutcome::kDone) return std::nullopt;
  return Failure{TrialOutcomeOf(end.outcome),
                 fmt::format("{}: {}", Name(end.outcome), end.reason)};
}

Progress Run(const Clamp& clamp, std::span<const Command>, Execution& execution) {
  constexpr double kSettle = 0.1;  // seconds for the part to settle
  execution.scene().Clamp(execution.data(), clamp.part, clamp.force);
  return execution.Stay(kSettle, Stepping::kContact);
}

}  // namespace assay::execution
