#include "planner/contingent/knowledge/open_bounds.h"

#include <algorithm>

namespace assay::contingent {

Diagram OpenBounds::WorldsWhere(const Bound& bound) {
  if (SurelyHolds(bound, RangeOf(bound))) return kAllSets;
  if (SurelyHolds(Negation(bound), RangeOf(bound))) return kEmptySet;
  const auto found = std::ranges::find(bounds_, bound);
  const std::size_t at = found - bounds_.begin();
  if (found == bounds_.end()) bounds_.push_back(bound);
  return diagrams_.Literal({VariableOf(at), true});
}

Diagram OpenBounds::Together() const {
  Diagram together = kAllSets;
  for (std::size_t a = 0; a < bounds_.size(); ++a) {
    for (std::size_t b = 0; b < bounds_.size(); ++b) {
      if (a == b || bounds_[a].function != bounds_[b].function) continue;
      for (const bool is_a : {true, false}) {
        const Range range = Narrowed(RangeOf(bounds_[a]), is_a ? bounds_[a] : Negation(bounds_[a]));
        for (const bool is_b : {true, false}) {
          if (!SurelyHolds(is_b ? bounds_[b] : Negation(bounds_[b]), range)) continue;
          together =
              diagrams_.And(together, diagrams_.Or(diagrams_.Literal({VariableOf(a), !is_a}),
                                                   diagrams_.Literal({VariableOf(b), is_b})));
        }
      }
    }
  }
  return together;
}

bool OpenBounds::AreOuter() const {
  return std::ranges::any_of(bounds_, [&](const Bound& bound) { return RangeOf(bound).is_outer; });
}

std::vector<int> OpenBounds::Variables() const {
  std::vector<int> variables;
  for (std::size_t i = 0; i < bounds_.size(); ++i) variables.push_back(VariableOf(i));
  return variables;
}

}  // namespace assay::contingent
