#include "planner/plan/certificates/condition_table.h"

#include <array>

#include "planner/base/check.h"

namespace assay::plan {

ConditionKinds KnownConditions() {
  using namespace condition;
  static constexpr auto kKinds = std::to_array<const ConditionKind*>(
      {&kBetweenFingers, &kFingerClear,   &kFingertip, &kPadContact,     &kUpright,
       &kPushedClear,    &kLandingHeight, &kFootprint, &kNeighbourClear, &kEntry,
       &kSlideIn,        &kTilt,          &kSeat,      &kPassingClear,   &kFixedStands,
       &kFixedStays,     &kInPlace,       &kTipShift,  &kTipTurn,        &kStanding,
       &kPressed,        &kHolding,       &kHandClear, &kReach,          &kWayClear});
  return kKinds;
}

std::vector<std::string> NamesOfConditions(ConditionKinds kinds) {
  std::vector<std::string> names;
  for (const ConditionKind* kind : kinds) names.emplace_back(kind->name);
  return names;
}

std::string_view WordsOf(Circumstance circumstance) {
  switch (circumstance) {
    case Circumstance::kUsual:
      return "";
    case Circumstance::kWayHome:
      return " on the way home";
    case Circumstance::kYieldingWrist:
      return " fits between the walls";
  }
  ASSAY_CHECK(false, "a circumstance that the switch does not know");
  return "";
}

Circumstance CircumstanceOf(std::string_view meaning) {
  for (const auto circumstance : {Circumstance::kWayHome, Circumstance::kYieldingWrist}) {
    if (meaning.ends_with(WordsOf(circumstance))) return circumstance;
  }
  return Circumstance::kUsual;
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
