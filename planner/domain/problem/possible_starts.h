#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "planner/domain/parts/placed_part.h"
#include "planner/domain/problem/problem.h"

namespace assay::domain {

// Returns the part on whose table the part is at the start. For a part that is assembled at the
// start, this is the part at the end of its chain of matings. For any other part it is the part
// itself.
PartId CarrierAtStart(const Problem& problem, PartId part);

// Two parts, the one that the problem names first before the other.
using PartPair = std::pair<PartId, PartId>;

// Knows at which poses the parts of a problem can be at the same time: no two of them overlap
// beyond contact. If the believed poses of two parts overlap by rounding, up to kGreatestOverlap,
// these parts may overlap by this much in all poses. Pockets are as narrow as the tolerance of the
// clearance permits.
class PossibleStarts {
 public:
  static constexpr double kGreatestOverlap = 1e-5;  // metres

  explicit PossibleStarts(const Problem& problem);

  bool Overlap(const PlacedPart& a, const PlacedPart& b) const;
  // Returns the first two parts that overlap at these poses, which are given by part. Returns none
  // if the parts can be there.
  std::optional<PartPair> FirstOverlap(std::span<const Pose> X_WorldPart) const;
  // Returns the distance of two parts, metres; 0 if they touch or overlap.
  double Between(const PlacedPart& a, const PlacedPart& b) const;

  const geometry::CollisionShape& shape(PartId part) const;
  // Returns the convex pieces of which the part's shape is the union.
  std::span<const geometry::ConvexHull> pieces(PartId part) const;

 private:
  std::vector<std::shared_ptr<const PartModel>> models_;  // by part, with the narrowest pockets
  std::vector<PartPair> touching_;  // parts whose believed poses overlap by rounding
};

// Returns the pairs of parts that overlap at the start for some of the declared errors. Pairs are
// found by branch and bound over the box of their errors. A pair is also returned if the search
// cannot exclude an overlap, either because its budget is spent, or because the overlap would be
// less than a hundredth of a millimetre. No pair that may overlap is ever missing.
std::vector<PartPair> PairsThatMayOverlap(const Problem& problem);

}  // namespace assay::domain
