#pragma once

#include <map>
#include <utility>
#include <vector>

#include "planner/finemotion/search/segment.h"

namespace assay::finemotion {

// What a search has come to believe. A belief is like a known one if it is at the same critical
// point and in the same contacts, its pose within a millimetre and about a degree of the known
// one's, and its errors about no axis clearly less: whatever it leads to, the known one is taken to
// lead to as well. Free of contact it may also be farther out: it can come back. Poses that are
// alike are not the same, so that this makes a search finite, and not complete.
class KnownBeliefs {
 public:
  // `mating`: the way in, a unit vector.
  explicit KnownBeliefs(const Vector3& mating) : mating_(mating) {}

  // False: one like it is known.
  bool Add(int critical_point, const Belief& belief);

 private:
  bool AreAlike(const Belief& known, const Belief& belief) const;

  Vector3 mating_;
  std::map<std::pair<int, std::vector<ContactKey>>, std::vector<Belief>> known_;
};

}  // namespace assay::finemotion
