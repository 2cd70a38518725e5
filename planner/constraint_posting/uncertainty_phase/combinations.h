#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace assay::constraint_posting {

// An item that concerns one subject. For example, a remedy concerns one part. A combination has at
// most one item of each subject.
struct Combinable {
  int group = 0;    // lower groups are preferred
  int subject = 0;  // the number of the item's subject
};

// Visits the combinations of at most `most` items with distinct subjects. The combinations of group
// 0 alone come first, the smaller ones first. The combinations that reach to group 1 come next, and
// so on. `items` must be sorted by group. Stops when `visit` returns true, and then returns true.
// Returns false after `budget` visits or when all combinations were visited.
bool VisitCombinations(const std::vector<Combinable>& items, int most, std::int64_t budget,
                       const std::function<bool(const std::vector<int>& chosen)>& visit);

}  // namespace assay::constraint_posting
