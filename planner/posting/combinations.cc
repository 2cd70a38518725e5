#include "planner/posting/combinations.h"

#include <algorithm>

#include "planner/base/budget.h"

namespace assay::posting {
namespace {

class Combinations {
 public:
  Combinations(const std::vector<int>& group_of, std::int64_t budget,
               const std::function<bool(const std::vector<int>&)>& visit)
      : group_of_(group_of), budget_(budget), visit_(visit) {}

  bool Run(int most) {
    const int groups = group_of_.empty() ? 0 : group_of_.back() + 1;
    for (group_ = 0; group_ < groups; ++group_) {
      for (int size = 1; size <= most; ++size) {
        if (Extend(size)) return true;
      }
    }
    return false;
  }

 private:
  // Items of the present group are needed, those of later ones not allowed.
  bool Extend(int missing) {
    if (missing == 0) {
      const bool reaches =
          std::ranges::any_of(chosen_, [&](int item) { return group_of_[item] == group_; });
      return reaches && budget_.Spend() && visit_(chosen_);
    }
    for (int item = 0; item < static_cast<int>(group_of_.size()); ++item) {
      if (!MayFollow(item)) continue;
      chosen_.push_back(item);
      const bool found = Extend(missing - 1);
      chosen_.pop_back();
      if (found) return true;
      if (budget_.Exhausted()) return false;
    }
    return false;
  }

  bool MayFollow(int item) const {
    if (group_of_[item] > group_ || std::ranges::count(chosen_, item) > 0) return false;
    if (chosen_.empty() || group_of_[item] > 0) return true;
    return group_of_[chosen_.back()] == 0 && chosen_.back() < item;
  }

  const std::vector<int>& group_of_;
  Budget budget_;
  const std::function<bool(const std::vector<int>&)>& visit_;
  int group_ = 0;
  std::vector<int> chosen_;
};

}  // namespace

bool VisitCombinations(const std::vector<int>& group_of, int most, std::int64_t budget,
                       const std::function<bool(const std::vector<int>& items)>& visit) {
  return Combinations(group_of, budget, visit).Run(most);
}

}  // namespace assay::posting
