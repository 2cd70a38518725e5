#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace assay::posting {

// Goes through the ways to combine items that come in groups, at most `most` at once: first those
// of group 0 alone, the smaller first, then those that reach to group 1 as well, and so on. Items
// of group 0 keep their order; of later groups every order is tried, because one squeeze can make
// the next one possible. `group_of` says the group of each item and does not decrease. Stops when
// `visit` answers true, and then answers true; or after `budget` visits.
bool VisitCombinations(const std::vector<int>& group_of, int most, std::int64_t budget,
                       const std::function<bool(const std::vector<int>& items)>& visit);

}  // namespace assay::posting
