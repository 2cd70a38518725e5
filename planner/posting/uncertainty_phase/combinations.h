#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace assay::posting {

// Something that may be combined with others of other subjects.
struct Combinable {
  int group = 0;    // lower groups are preferred
  int subject = 0;  // what it is about
};

// Goes through the combinations of at most `most` items, of distinct subjects: first those of group
// 0 alone, the smaller first, then those that reach to group 1 as well, and so on. Items come in
// the order of their groups. Stops when `visit` answers true, and then answers true; or after
// `budget` visits.
bool VisitCombinations(const std::vector<Combinable>& items, int most, std::int64_t budget,
                       const std::function<bool(const std::vector<int>& chosen)>& visit);

}  // namespace assay::posting
