#include "planner/plan/checker/linearization.h"

#include <algorithm>

namespace assay::plan {
namespace {

// Visits orders depth-first over prefixes: a step may come next after all steps that must precede
// it have come.
class LinearizationVisitor {
 public:
  LinearizationVisitor(int steps, const Ordering& ordering,
                       const std::function<Visit(const std::vector<StepId>&)>& visit)
      : waits_for_(steps, 0), placed_(steps, Placed::kNo), ordering_(ordering), visit_(visit) {
    for (const auto& [first, second] : ordering) ++waits_for_[second.index()];
  }

  Visit Extend() {
    if (order_.size() == placed_.size()) return visit_(order_);
    for (std::size_t i = 0; i < placed_.size(); ++i) {
      if (placed_[i] == Placed::kYes || waits_for_[i] > 0) continue;
      Place(StepId(i));
      const Visit next = Extend();
      TakeBack(StepId(i));
      if (next == Visit::kStop) return Visit::kStop;
    }
    return Visit::kContinue;
  }

 private:
  enum class Placed { kNo, kYes };

  void Place(StepId step) {
    placed_[step.index()] = Placed::kYes;
    order_.push_back(step);
    for (const auto& [first, second] : ordering_) waits_for_[second.index()] -= first == step;
  }

  void TakeBack(StepId step) {
    placed_[step.index()] = Placed::kNo;
    order_.pop_back();
    for (const auto& [first, second] : ordering_) waits_for_[second.index()] += first == step;
  }

  std::vector<int> waits_for_;  // number of pairs of the ordering that hold each step back
  std::vector<Placed> placed_;
  std::vector<StepId> order_;
  const Ordering& ordering_;
  const std::function<Visit(const std::vector<StepId>&)>& visit_;
};

}  // namespace

// Uses the method of Kahn (1962), without a queue, since plans are short.
bool IsAcyclic(int steps, const Ordering& ordering) {
  Ordering open = ordering;
  for (int round = 0; round < steps && !open.empty(); ++round) {
    const Ordering before = open;
    std::erase_if(open, [&](const auto& pair) {
      return std::ranges::none_of(before,
                                  [&](const auto& other) { return other.second == pair.first; });
    });
  }
  return open.empty();
}

std::pair<StepId, StepId> FirstBroken(const Ordering& ordering, const std::vector<StepId>& order) {
  for (const auto& [first, second] : ordering) {
    if (std::ranges::find(order, first) >= std::ranges::find(order, second)) {
      return {first, second};
    }
  }
  return {StepId::None(), StepId::None()};
}

bool VisitLinearizations(int steps, const Ordering& ordering,
                         const std::function<Visit(const std::vector<StepId>&)>& visit) {
  return LinearizationVisitor(steps, ordering, visit).Extend() == Visit::kContinue;
}

}  // namespace assay::plan
