#include "planner/posting/uncertainty_phase/uncertainty_phase.h"

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "planner/base/check.h"
#include "planner/posting/uncertainty_phase/instances/augmented_plan.h"
#include "planner/posting/uncertainty_phase/instances/best_instance.h"
#include "planner/posting/uncertainty_phase/instances/instance_judge.h"

namespace assay::posting {
namespace {

class CertifiedPlanning {
 public:
  CertifiedPlanning(const domain::Problem& problem, const PlannerOptions& planner,
                    const UncertaintyOptions& options)
      : planner_(planner), relations_(problem), task_(problem, options), best_(task_) {}

  // The first instances tell how many errors no search can spare; those beyond are searched for.
  plan::PlanResult Run() {
    plan::PlanResult result = AmongTheFirst();
    if (!best_.exists()) return Answer(std::move(result));
    // What fails with all grasps that there are may not fail with one that parts are in the way of.
    Search(0, {}, result);
    const std::vector<Subject> anywhere = best_.FailingAnywhere();
    const int least = std::max(best_.certain_errors(), static_cast<int>(anywhere.size()));
    for (int errors = std::max(1, least); errors < best_.errors(); ++errors) {
      Search(errors, anywhere, result);
    }
    if (best_.is_proved() && best_.actions() > result.counters.at("least_actions")) {
      Join(WithErrors(0, {}, IfUnproved::kObject), result);  // which may spare actions
    }
    return Answer(std::move(result));
  }

 private:
  // Unless the best plan has no more errors.
  void Search(int errors, const std::vector<Subject>& anywhere, plan::PlanResult& result) {
    for (const IfUnproved way : {IfUnproved::kObjectAtOnce, IfUnproved::kObject}) {
      if (errors < best_.errors()) Join(WithErrors(errors, anywhere, way), result);
    }
  }

  // Looks for a plan in which so many steps are not proved, at most: steps that fail are mended by
  // other instances, and by goals for the first phase. `anywhere`: what fails wherever parts are in
  // the best plan. Other places are mostly found sooner than remedies that make them unnecessary.
  plan::PlanResult WithErrors(int errors, const std::vector<Subject>& anywhere,
                              IfUnproved if_unproved) {
    const int by_place = std::max(0, errors - static_cast<int>(anywhere.size()));
    InstanceJudge judge(task_, {errors, by_place, anywhere}, if_unproved);
    PlannerOptions first_phase = planner_;
    first_phase.moments = task_.options.moments;
    first_phase.judge = std::ref(judge);
    std::int64_t refused = 0;
    first_phase.accept = [&](const plan::Plan& instance) {
      if (!CanBeExecuted(instance)) return ++refused >= task_.options.instances;
      best_.TakeIfBetter(instance);
      return true;
    };
    return MakePlan(task_.problem, relations_, first_phase);
  }

  // The best of the first instances, with whatever errors.
  plan::PlanResult AmongTheFirst() {
    PlannerOptions first_phase = planner_;
    std::int64_t considered = 0;
    first_phase.accept = [&](const plan::Plan& instance) {
      if (CanBeExecuted(instance)) best_.Consider(instance);
      return best_.is_proved() || ++considered >= task_.options.instances;
    };
    plan::PlanResult result = MakePlan(task_.problem, relations_, first_phase);
    if (!best_.is_proved()) best_.ConsiderWaiting();
    return result;
  }

  bool CanBeExecuted(const plan::Plan& instance) const {
    return !task_.options.can_be_executed || task_.options.can_be_executed(instance);
  }

  // Counts the work of another search, whose outcome is the last.
  static void Join(plan::PlanResult other, plan::PlanResult& result) {
    result.outcome = other.outcome;
    for (const auto& [name, count] : other.counters) {
      if (name != "least_actions") result.counters[name] += count;
    }
  }

  plan::PlanResult Answer(plan::PlanResult result) {
    result.counters["remedies"] = best_.combinations();
    if (best_.exists()) {
      result.outcome = Outcome::kFound;
      result.conflict.clear();
      result.plan = best_.WriteOut();
    } else if (result.outcome == Outcome::kFound) {  // but nothing that can be executed
      result.outcome = Outcome::kBudget;
      result.plan = {};
    }
    return result;
  }

  const PlannerOptions& planner_;
  const GeometricRelations relations_;
  UncertaintyTask task_;
  BestInstance best_;
};

}  // namespace

AugmentedPlanInstance Augment(const domain::Problem& problem, const plan::Plan& instance,
                              const UncertaintyOptions& options) {
  const UncertaintyOptions complete = WithDefaults(options);
  UncertaintyTask task(problem, complete);
  const Augmentation augmentation(task, instance);
  return {.plan = AugmentedPlan(task, augmentation.steps(), instance),
          .violation = augmentation.standing().violation,
          .combinations = augmentation.combinations()};
}

plan::PlanResult MakeCertifiedPlan(const domain::Problem& problem, const PlannerOptions& planner,
                                   const UncertaintyOptions& options) {
  ASSAY_CHECK(!planner.accept && !planner.judge,
              "which instance is accepted is for the uncertainty phase to say");
  const UncertaintyOptions complete = WithDefaults(options);
  return CertifiedPlanning(problem, planner, complete).Run();
}

}  // namespace assay::posting
