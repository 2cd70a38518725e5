#include "planner/constraint_posting/uncertainty_phase/uncertainty_phase.h"

#include <algorithm>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "planner/base/check.h"
#include "planner/constraint_posting/uncertainty_phase/augmentation/augmented_plan.h"
#include "planner/constraint_posting/uncertainty_phase/augmentation/best_instance.h"
#include "planner/constraint_posting/uncertainty_phase/augmentation/instance_judge.h"

namespace assay::constraint_posting {
namespace {

class CertifiedPlanning {
 public:
  CertifiedPlanning(const domain::Problem& problem, const PlannerOptions& planner,
                    const UncertaintyOptions& options)
      : planner_(planner), relations_(problem), task_(problem, options), best_(task_) {}

  // A number of errors in this class is the number of steps of a plan that are not proved (Spar's
  // error count). The first plan instances show which steps fail wherever the parts are. Later
  // searches look for plans in which all other steps are proved.
  plan::PlanResult Run() {
    plan::PlanResult result = AmongTheFirst();
    if (!best_.exists()) return Answer(std::move(result));
    // If a step fails with all grasps that are available, another grasp may still prove it: a grasp
    // that parts block in these instances. The first search therefore accepts no unproved step.
    Search(0, {}, result);
    const std::vector<Subject> anywhere = best_.FailingAnywhere();
    const int least = std::max(best_.certain_errors(), static_cast<int>(anywhere.size()));
    for (int errors = std::max(1, least); errors < best_.errors(); ++errors) {
      Search(errors, anywhere, result);
    }
    if (best_.is_proved() && best_.actions() > result.counters.at("least_actions")) {
      Join(WithErrors(0, {}, IfUnproved::kObject), result);  // the search may save actions
    }
    return Answer(std::move(result));
  }

 private:
  // Searches for a plan in which at most `errors` steps are not proved, if the best plan has more.
  void Search(int errors, const std::vector<Subject>& anywhere, plan::PlanResult& result) {
    for (const IfUnproved way : {IfUnproved::kObjectAtOnce, IfUnproved::kObject}) {
      if (errors < best_.errors()) Join(WithErrors(errors, anywhere, way), result);
    }
  }

  // Searches for a plan in which at most `errors` steps are not proved. If a step fails, the search
  // tries other instances and new goals of the first phase. `anywhere` lists those actions of the
  // best plan, by kind and parts, that fail wherever the parts are. It is usually quicker to find
  // other places for the parts than to find remedies with which the parts can stay.
  plan::PlanResult WithErrors(int errors, const std::vector<Subject>& anywhere,
                              IfUnproved if_unproved) {
    const int by_place = std::max(0, errors - static_cast<int>(anywhere.size()));
    InstanceJudge judge(task_, {errors, by_place, anywhere}, if_unproved);
    PlannerOptions first_phase = planner_;
    first_phase.snapshots = task_.options.snapshots;
    first_phase.judge = [&](std::span<const plan::Action> actions) {
      Judgement judgement = task_.options.judge ? task_.options.judge(actions) : Judgement{};
      return judgement.objections.empty() ? judge(actions) : judgement;
    };
    std::int64_t refused = 0;
    first_phase.accept = [&](const plan::Plan& instance) {
      if (!CanBeExecuted(instance)) return ++refused >= task_.options.instances;
      best_.TakeIfBetter(instance);
      return true;
    };
    return MakePlan(task_.problem, relations_, first_phase);
  }

  // Returns the best of the first instances, with any number of unproved steps.
  plan::PlanResult AmongTheFirst() {
    PlannerOptions first_phase = planner_;
    first_phase.judge = task_.options.judge;
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

  // Adds the counters of another search to the result, which gets the outcome of that search.
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
    } else if (result.outcome == Outcome::kFound) {  // plans were found, but none can be executed
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

}  // namespace assay::constraint_posting
