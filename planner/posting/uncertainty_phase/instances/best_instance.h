#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "planner/plan/data/plan.h"
#include "planner/posting/uncertainty_phase/instances/augmentation.h"

namespace assay::posting {

// The best of the plan instances that were augmented. Instances of which it is known beforehand
// that not all can be proved wait until all are there: then those are augmented that could still
// come first, the most promising first, one of those that promise the same.
class BestInstance {
 public:
  explicit BestInstance(UncertaintyTask& task)
      : task_(task), for_violation_(task.options.instances_for_violation) {}

  void Consider(const plan::Plan& instance);
  void ConsiderWaiting();
  void TakeIfBetter(const plan::Plan& instance);

  bool exists() const { return best_.has_value(); }
  // Of the best, which must exist.
  int errors() const { return best_->augmentation.standing().errors; }
  std::vector<Subject> FailingAnywhere() const { return best_->augmentation.FailingAnywhere(); }
  std::int64_t actions() const { return std::ssize(best_->instance.steps); }
  plan::Plan WriteOut() const;

  bool is_proved() const { return exists() && errors() == 0; }
  // Steps that no remedies can better, wherever parts are: the least of all that were considered.
  int certain_errors() const { return certain_errors_; }
  std::int64_t combinations() const { return combinations_; }  // of remedies that were tried

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
  std::int64_t for_violation_;  // that are still to be augmented
  int certain_errors_ = std::numeric_limits<int>::max();
  std::vector<Waiting> waiting_;
  std::optional<Augmented> best_;
  std::int64_t combinations_ = 0;
};

}  // namespace assay::posting
