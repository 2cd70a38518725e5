#include "planner/plan/data/condition_table.h"

#include <array>

namespace assay::plan {

ConditionKinds KnownConditions() {
  using namespace condition;
  static constexpr auto kKinds = std::to_array<const ConditionKind*>(
      {&kBetweenFingers, &kFingerClear,  &kFingertip,      &kPadContact, &kUpright,  &kPushedClear,
       &kLandingHeight,  &kFootprint,    &kNeighbourClear, &kEntry,      &kSlideIn,  &kTilt,
       &kSeat,           &kPassingClear, &kFixedStands,    &kFixedStays, &kTipShift, &kTipTurn,
       &kStanding,       &kPressed,      &kHolding,        &kHandClear,  &kReach,    &kWayClear});
  return kKinds;
}

std::vector<std::string> NamesOfConditions(ConditionKinds kinds) {
  std::vector<std::string> names;
  for (const ConditionKind* kind : kinds) names.emplace_back(kind->name);
  return names;
}

const std::vector<Condition>& AbsorbedByFineMotion() {
  static const std::vector<Condition> absorbed = [] {
    std::vector<Condition> conditions;
    for (const ConditionKind* kind : KnownConditions()) {
      if (kind->absorbed_by == AbsorbedBy::kFineMotion) conditions.emplace_back(*kind);
    }
    return conditions;
  }();
  return absorbed;
}

}  // namespace assay::plan
