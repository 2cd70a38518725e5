#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "planner/constraint_posting/uncertainty_phase/augmentation/augmentation.h"
#include "planner/plan/data/plan.h"

namespace assay::constraint_posting {

// The best of the augmented plan instances. An instance that surely cannot be proved completely
// waits until all instances are there. Then those waiting instances that could still become the
// best are augmented, the most promising first. Only one of several equally promising instances is
// augmented.
class BestInstance {
 public:
  explicit BestInstance(UncertaintyTask& task)
      : task_(task), for_violation_(task.options.instances_for_violation) {}

  void Consider(const plan::Plan& instance);
  void ConsiderWaiting();
  void TakeIfBetter(const plan::Plan& instance);

  bool exists() const { return best_.has_value(); }
  // The best instance must exist.
  int errors() const { return best_->augmentation.standing().errors; }
  std::vector<Subject> FailingAnywhere() const { return best_->augmentation.FailingAnywhere(); }
  std::int64_t actions() const { return std::ssize(best_->instance.steps); }
  plan::Plan WriteOut() const;

  bool is_proved() const { return exists() && errors() == 0; }
  // The least number, over all considered instances, of steps that no remedies can prove wherever
  // parts are.
  int certain_errors() const { return certain_errors_; }
  // the number of combinations of remedies that were tried
  std::int64_t combinations() const { return combinations_; }

 private:
  struct Waiting {
    Standing least;
    plan::Plan instance;
  };
  struct Augmented {
    plan::Plan instance;
    Augmentation augmentation;
  };

  bool IsWorthAugmenting(const Standing& least);

  UncertaintyTask& task_;
  // the number of instances that may still be augmented for their violation alone
  std::int64_t for_violation_;
  int certain_errors_ = std::numeric_limits<int>::max();
  std::vector<Waiting> waiting_;
  std::optional<Augmented> best_;
  std::int64_t combinations_ = 0;
};

}  // namespace assay::constraint_posting
