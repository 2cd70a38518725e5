#include "planner/constraint_posting/uncertainty_phase/augmentation/augmented_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "planner/base/check.h"
#include "planner/constraint_posting/uncertainty_phase/unproved_goals.h"
#include "planner/constraint_posting/uncertainty_phase/verification.h"
#include "planner/plan/checker/linearization.h"

namespace assay::constraint_posting {
namespace {

using plan::Resolution;
using uncertainty::SnapshotId;
using uncertainty::Unproved;

class PlanWriter {
 public:
  PlanWriter(UncertaintyTask& task, const AugmentedSteps& steps, const plan::Plan& instance)
      : task_(task),
        steps_(steps),
        world_(task.problem, task.options.propagation),
        plan_(instance) {}

  plan::Plan Write() {
    plan_.errors = static_cast<int>(std::ranges::count_if(steps_, &AugmentedStep::fails));
    plan_.steps.resize(static_cast<std::size_t>(steps_.size()));
    for (int i = 0; i < steps_.size(); ++i) Write(steps_[i], i + 1);
    if (!IsProvedInEveryOrder()) OrderAsExecuted();
    return std::move(plan_);
  }

 private:
  void Write(const AugmentedStep& step, int executed) {
    plan::PlannedStep& written = plan_.steps[step.id.index()];
    if (steps_.IsInserted(step)) {
      written.name = fmt::format("action_{}", step.id.index() + 1);
      written.action = step.action;
      written.inserted = step.id.index() + 1;
    }
    written.executed = executed;
    written.strategy = step.strategy;
    uncertainty::CertifiedStep certified =
        CertifyStep(world_, step.action, task_.options.bound, step.way());
    const bool is_proved = step.Unabsorbed(std::move(certified.unproved)).empty();
    ASSAY_CHECK(is_proved == !step.fails(), "'{}' is certified otherwise than it was decided",
                written.name);
    // The first phase has written resolutions that say which parts were moved for this step. They
    // are kept.
    std::vector<Resolution> resolutions = std::move(written.certificate.resolutions);
    written.certificate = std::move(certified.certificate);
    written.certificate.resolutions = std::move(resolutions);
    for (const Measure& measure : step.measures) {
      // A step that could only be verified may have been proved after all by a measure for a later
      // step.
      if (measure.resolver == kVerification && !step.fails()) continue;
      written.certificate.resolutions.push_back(InWords(measure));
    }
    if (step.fails()) {
      AddVerification(task_.problem, step.id, written.action, written.certificate, plan_);
    }
  }

  Resolution InWords(const Measure& measure) const {
    Resolution resolution = {
        .resolver = measure.resolver, .steps = measure.steps, .why = Why(measure.because)};
    if (const auto& less = measure.without_moving) {
      resolution.why += fmt::format("; after {} still {}", less->resolver, Why(less->still));
    }
    return resolution;
  }

  // Returns the goal with the greatest violation, in the words of the certificate.
  std::string Why(const Unmet& unmet) const {
    const std::vector<Unproved> unproved =
        WithoutConditions(unmet.absorbed, task_.possible.UnprovedAt(unmet.after));
    const auto margin = [](const Unproved& goal) { return goal.claim.margin; };
    const Unproved& worst = *std::ranges::min_element(unproved, {}, margin);
    return WhyUnproved(task_.possible.Certified(unmet.after, worst).claim);
  }

  // A plan with inserted actions was certified only for the order of execution. A plan without
  // inserted actions may be proved in every order.
  bool IsProvedInEveryOrder() const {
    if (static_cast<std::size_t>(steps_.size()) > steps_.of_instance()) return false;
    const auto is_proved_in = [&](const std::vector<plan::StepId>& order) {
      SnapshotId snapshot = task_.possible.Beginning();
      return std::ranges::all_of(order, [&](plan::StepId id) {
        const AugmentedStep& step = *std::ranges::find(steps_, id, &AugmentedStep::id);
        snapshot = task_.possible.After(snapshot, step.action, step.way());
        return step.fails() || step.IsProved(task_.possible, snapshot);
      });
    };
    return plan::VisitLinearizations(
        static_cast<int>(steps_.of_instance()), plan_.ordering, [&](const auto& order) {
          return is_proved_in(order) ? plan::Visit::kContinue : plan::Visit::kStop;
        });
  }

  void OrderAsExecuted() {
    plan_.ordering.clear();
    for (int i = 1; i < steps_.size(); ++i) {
      plan_.ordering.emplace_back(steps_[i - 1].id, steps_[i].id);
    }
  }

  UncertaintyTask& task_;
  const AugmentedSteps& steps_;
  uncertainty::UncertainWorld world_;
  plan::Plan plan_;
};

}  // namespace

plan::Plan AugmentedPlan(UncertaintyTask& task, const AugmentedSteps& steps,
                         const plan::Plan& instance) {
  return PlanWriter(task, steps, instance).Write();
}

}  // namespace assay::constraint_posting
