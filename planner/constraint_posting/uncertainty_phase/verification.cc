#include "planner/constraint_posting/uncertainty_phase/verification.h"

#include <algorithm>
#include <numbers>
#include <optional>

#include "planner/base/check.h"

namespace assay::constraint_posting {
namespace {

using domain::MeasuredQuantity;
using domain::VerifiedAction;

// The expected measurements after an action, in metres.
struct Expected {
  VerifiedAction action;
  double opening = 0;      // the distance between the pads
  double tool_height = 0;  // the tool's height above the table
};

double HeightOf(const geometry::Pose& X_WorldTool) { return X_WorldTool.translation().z(); }

struct ExpectedAfter {
  const domain::Problem& problem;

  std::optional<Expected> operator()(const plan::Pickup& pickup) const {
    return Expected{VerifiedAction::kPickup, pickup.hold.width,
                    HeightOf(pickup.from.X_WorldPart * pickup.hold.X_PartTool)};
  }
  std::optional<Expected> operator()(const plan::Putdown& putdown) const {
    return Expected{VerifiedAction::kPutdown, putdown.hold.width,
                    HeightOf(putdown.to.X_WorldPart * putdown.hold.X_PartTool)};
  }
  std::optional<Expected> operator()(const plan::Assemble& assemble) const {
    const domain::Mating& mating = problem.mating(assemble.mating);
    return Expected{
        VerifiedAction::kAssemble, assemble.hold.width,
        HeightOf(assemble.fixed.X_WorldPart * mating.X_FixedHeld * assemble.hold.X_PartTool)};
  }
  // Sensing and squeezing are inserted only where they are proved.
  std::optional<Expected> operator()(const plan::Sense&) const { return std::nullopt; }
  std::optional<Expected> operator()(const plan::Squeeze&) const { return std::nullopt; }
};

// The greatest pitch of a search that misses no place, in metres. A shaft finds its hole within a
// square of twice the clearance, however this square is turned against the search. A tenth is
// reserved for the rotation of the parts against each other.
struct FinestPitch {
  const domain::Problem& problem;

  double operator()(const plan::Assemble& assemble) const {
    const domain::Mating& mating = problem.mating(assemble.mating);
    const double clearance = std::max(problem.part(mating.held).model->clearance(),
                                      problem.part(mating.fixed).model->clearance());
    return clearance > 0 ? 0.9 * std::numbers::sqrt2 * clearance : kCoarse;
  }
  double operator()(const auto&) const { return kCoarse; }

  static constexpr double kCoarse = 1;  // metres: no limit
};

void AddRecovery(const domain::Workcell& workcell, plan::StepId step, const std::string& error,
                 double finest_pitch, plan::Plan& plan) {
  const bool known = std::ranges::any_of(plan.recoveries, [&](const plan::Recovery& recovery) {
    return recovery.step == step && recovery.error == error;
  });
  if (error.empty() || known) return;
  const auto& templates = workcell.uncertainty_operations().recoveries;
  const auto found = std::ranges::find(templates, error, &domain::RecoveryTemplate::error);
  ASSAY_CHECK(found != templates.end(), "the workcell has no recovery from '{}'", error);
  plan.recoveries.push_back({.step = step,
                             .error = error,
                             .strategy = found->strategy,
                             .radius = found->radius,
                             .pitch = std::min(found->pitch, finest_pitch)});
}

}  // namespace

void AddVerification(const domain::Problem& problem, plan::StepId step, const plan::Action& action,
                     const plan::Certificate& certificate, plan::Plan& plan) {
  const std::optional<Expected> expected = std::visit(ExpectedAfter{problem}, action);
  if (!expected) return;
  const double pitch = std::visit(FinestPitch{problem}, action);
  const double doubt = plan::DoubtOfContact(certificate, problem.workcell->rules().guarded_travel);
  for (const domain::VerificationTemplate& check :
       problem.workcell->uncertainty_operations().verifications) {
    if (check.after != expected->action) continue;
    // Even without a failure, the height at which contact is made is uncertain by `doubt`. The
    // expected opening has no such uncertainty.
    const bool is_height = check.quantity == MeasuredQuantity::kToolHeight;
    plan.verifications.push_back({.step = step,
                                  .name = check.name,
                                  .quantity = check.quantity,
                                  .expected = is_height ? expected->tool_height : expected->opening,
                                  .tolerance = check.tolerance + (is_height ? doubt : 0),
                                  .below = check.below,
                                  .above = check.above});
    AddRecovery(*problem.workcell, step, check.below, pitch, plan);
    AddRecovery(*problem.workcell, step, check.above, pitch, plan);
  }
}

}  // namespace assay::constraint_posting
