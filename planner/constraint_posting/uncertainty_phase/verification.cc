#include "planner/constraint_posting/uncertainty_phase/verification.h"

#include <algorithm>
#include <numbers>

#include "planner/base/check.h"

namespace assay::constraint_posting {
namespace {

using domain::MeasuredQuantity;
using geometry::Pose;

// Returns the expected value of a measurement after an action, in metres: the distance between the
// pads, or the tool's height above the table.
double ExpectedAfter(const domain::Problem& problem, const plan::Action& action,
                     MeasuredQuantity quantity) {
  if (quantity == MeasuredQuantity::kGripperOpening) return action.hold.width;
  const Pose X_WorldTool = plan::HandledAt(problem, action) * action.hold.X_PartTool;
  return X_WorldTool.translation().z();
}

// Returns the greatest pitch of a search that misses no place, in metres. A shaft finds its hole
// within a square of twice the clearance, however this square is turned against the search. A tenth
// is reserved for the rotation of the parts against each other.
double FinestPitch(const domain::Problem& problem, const plan::Action& action) {
  constexpr double kCoarse = 1;  // metres: no limit
  if (action.mating.IsNone()) return kCoarse;
  const domain::Mating& mating = problem.mating(action.mating);
  const double clearance = std::max(problem.part(mating.held).model->clearance(),
                                    problem.part(mating.fixed).model->clearance());
  return clearance > 0 ? 0.9 * std::numbers::sqrt2 * clearance : kCoarse;
}

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
  const double pitch = FinestPitch(problem, action);
  const double doubt = plan::DoubtOfContact(certificate, problem.workcell->rules().guarded_travel);
  for (const domain::VerificationTemplate& check :
       problem.workcell->uncertainty_operations().verifications) {
    if (check.after != action.kind) continue;
    // Even without a failure, the height at which contact is made is uncertain by `doubt`. The
    // expected opening has no such uncertainty.
    const bool is_height = check.quantity == MeasuredQuantity::kToolHeight;
    plan.verifications.push_back({.step = step,
                                  .name = check.name,
                                  .quantity = check.quantity,
                                  .expected = ExpectedAfter(problem, action, check.quantity),
                                  .tolerance = check.tolerance + (is_height ? doubt : 0),
                                  .below = check.below,
                                  .above = check.above});
    AddRecovery(*problem.workcell, step, check.below, pitch, plan);
    AddRecovery(*problem.workcell, step, check.above, pitch, plan);
  }
}

}  // namespace assay::constraint_posting
