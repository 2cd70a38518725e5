#include "planner/constraint_posting/uncertainty_phase/combinations.h"

#include <algorithm>

#include "planner/base/budget.h"

namespace assay::constraint_posting {
namespace {

using Visit = std::function<bool(const std::vector<int>&)>;

class Combinations {
 public:
  Combinations(const std::vector<Combinable>& items, std::int64_t budget, const Visit& visit)
      : items_(items), budget_(budget), visit_(visit) {}

  bool Run(int most) {
    const int groups = items_.empty() ? 0 : items_.back().group + 1;
    for (group_ = 0; group_ < groups; ++group_) {
      for (int size = 1; size <= most; ++size) {
        if (Extend(0, size)) return true;
      }
    }
    return false;
  }

 private:
  // Adds `missing` more items, from index `next` on, to the chosen ones. Visits only combinations
  // whose last item belongs to the group `group_`, so that each combination is visited once.
  bool Extend(int next, int missing) {
    if (missing == 0) {
      return items_[chosen_.back()].group == group_ && budget_.Spend() && visit_(chosen_);
    }
    for (int item = next; item < static_cast<int>(items_.size()); ++item) {
      if (items_[item].group > group_ || budget_.Exhausted()) break;
      if (IsSubjectTaken(items_[item].subject)) continue;
      chosen_.push_back(item);
      const bool found = Extend(item + 1, missing - 1);
      chosen_.pop_back();
      if (found) return true;
    }
    return false;
  }

  bool IsSubjectTaken(int subject) const {
    return std::ranges::any_of(chosen_, [&](int item) { return items_[item].subject == subject; });
  }

  const std::vector<Combinable>& items_;
  Budget budget_;
  const Visit& visit_;
  int group_ = 0;
  std::vector<int> chosen_;
};

}  // namespace

bool VisitCombinations(const std::vector<Combinable>& items, int most, std::int64_t budget,
                       const Visit& visit) {
  return Combinations(items, budget, visit).Run(most);
}

}  // namespace assay::constraint_posting
