#pragma once

#include <map>
#include <utility>
#include <vector>

#include "planner/finemotion/motions/segment.h"

namespace assay::finemotion {

// The believed poses that a search has reached. A believed pose is like a known one if three
// conditions hold. The two poses are at the same critical point and in the same contacts. They
// differ by at most a millimetre and about a degree. The errors of the new pose are not clearly
// less about any axis than those of the known pose. The search then assumes that the known pose
// leads to everything to which the new pose leads. A pose without contact also counts as like a
// known pose that is less far out, since the part can come back. Poses that are alike are not
// equal, so this makes a search finite but not complete.
class KnownPoses {
 public:
  // `mating` is the way in, a unit vector.
  explicit KnownPoses(const Vector3& mating) : mating_(mating) {}

  // Adds the believed pose. Returns false, and adds nothing, if one like it is known.
  bool Add(int critical_point, const BelievedPose& believed);

 private:
  bool AreAlike(const BelievedPose& known, const BelievedPose& believed) const;

  Vector3 mating_;
  std::map<std::pair<int, std::vector<ContactKey>>, std::vector<BelievedPose>> known_;
};

}  // namespace assay::finemotion
