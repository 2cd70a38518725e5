#include "planner/constraint_posting/uncertainty_phase/augmentation/best_instance.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "planner/constraint_posting/uncertainty_phase/augmentation/augmented_plan.h"
#include "planner/constraint_posting/uncertainty_phase/unproved_goals.h"

namespace assay::constraint_posting {
namespace {

using uncertainty::SnapshotId;

// Lower bounds for any remedies.
struct Least {
  Standing standing;
  // the number of steps that no remedies can prove wherever on the table parts are
  int certain_errors = 0;
};

Least LeastOf(const plan::Plan& instance, UncertaintyTask& task) {
  Least least = {.standing = {.actions = instance.steps.size()}};
  if (!task.best) return least;
  const std::vector<plan::Condition> absorbable = task.options.Absorbable();
  SnapshotId snapshot = task.best->Beginning();
  for (const plan::StepId id : instance.ExecutionOrder()) {
    snapshot = task.best->After(snapshot, instance.step(id).action, nullptr);
    const Shortfall shortfall = task.best->LeastShortfall(snapshot, absorbable);
    least.standing.errors += shortfall.goals > 0 ? 1 : 0;
    least.standing.violation += shortfall.violation;
    const auto unproved = task.best->UnprovedAt(snapshot, absorbable);
    least.certain_errors += std::ranges::all_of(unproved, DependsOnPlace) ? 0 : 1;
  }
  return least;
}

// A hand turned by half a turn grasps equally well, so one of the two instances is enough.
bool IsAsGood(const Standing& a, const Standing& b) {
  constexpr double kSameViolation = 1e-6;
  return a.errors == b.errors && a.actions == b.actions &&
         std::abs(a.violation - b.violation) < kSameViolation;
}

}  // namespace

void BestInstance::Consider(const plan::Plan& instance) {
  const Least least = LeastOf(instance, task_);
  certain_errors_ = std::min(certain_errors_, least.certain_errors);
  if (least.standing.errors > 0) {
    waiting_.push_back({least.standing, instance});
  } else {
    TakeIfBetter(instance);
  }
}

void BestInstance::ConsiderWaiting() {
  std::ranges::stable_sort(waiting_, {}, &Waiting::least);
  std::optional<Standing> promised;
  for (const auto& [least, instance] : waiting_) {
    if (promised && IsAsGood(*promised, least)) continue;
    if (!IsWorthAugmenting(least)) continue;
    promised = least;
    TakeIfBetter(instance);
  }
  waiting_.clear();
}

void BestInstance::TakeIfBetter(const plan::Plan& instance) {
  Augmentation augmentation(task_, instance);
  combinations_ += augmentation.combinations();
  if (best_ && !(augmentation.standing() < best_->augmentation.standing())) return;
  best_ = {instance, std::move(augmentation)};
}

plan::Plan BestInstance::WriteOut() const {
  return AugmentedPlan(task_, best_->augmentation.steps(), best_->instance);
}

// Returns true if the instance might come before the best one. The number of instances that might
// do so by their violation alone is limited.
bool BestInstance::IsWorthAugmenting(const Standing& least) {
  if (!best_) return true;
  const Standing best = best_->augmentation.standing();
  if (!(least < best)) return false;
  const bool may_have_fewer =
      std::tie(least.errors, least.actions) < std::tie(best.errors, best.actions);
  return may_have_fewer || for_violation_-- > 0;
}

}  // namespace assay::constraint_posting
