#include "planner/plan/data/condition_kind.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "planner/base/check.h"

namespace assay::plan {
namespace {

constexpr std::string_view kNothingNear = "no other part is near enough to be met";
constexpr std::string_view kToldAsNotCovered =
    "it is not proved, and the plan names the step among what is not covered";

constexpr auto kKinds = std::to_array<ConditionKind>({
    {"between fingers", Quantity::kLength, NeededBy::kGrasp, true},
    {"finger clear", Quantity::kLength, NeededBy::kGrasp, false},
    {"fingertip", Quantity::kLength, NeededBy::kHandWork, false},
    {"pad contact", Quantity::kLength, NeededBy::kGrasp, false},
    {"upright", Quantity::kRatio, NeededBy::kGrasp, false},
    {"pushed clear", Quantity::kLength, NeededBy::kGrasp, false, kNothingNear},
    {"landing height", Quantity::kLength, NeededBy::kPutdown, true},
    {"footprint", Quantity::kLength, NeededBy::kPutdown, true},
    {"neighbour clear", Quantity::kLength, NeededBy::kPutdown, true, kNothingNear},
    {"entry", Quantity::kLength, NeededBy::kMating, true},
    {"slide-in", Quantity::kLength, NeededBy::kMating, true},
    {"tilt", Quantity::kAngle, NeededBy::kMating, true},
    {"seat", Quantity::kLength, NeededBy::kMating, true},
    {"passing clear", Quantity::kLength, NeededBy::kMating, false, kNothingNear},
    {"fixed stands", Quantity::kRatio, NeededBy::kMating, false},
    {"fixed stays", Quantity::kRatio, NeededBy::kMating, false},
    {"tip shift", Quantity::kLength, NeededBy::kStrategy, true},
    {"tip turn", Quantity::kAngle, NeededBy::kStrategy, true},
    {"standing", Quantity::kRatio, NeededBy::kRelease, false},
    {"pressed", Quantity::kRatio, NeededBy::kRelease, false},
    {"holding", Quantity::kRatio, NeededBy::kCarrying, false},
    {"hand clear", Quantity::kLength, NeededBy::kHandWork, false, kNothingNear},
    {"reach", Quantity::kAngle, NeededBy::kWay, false, kToldAsNotCovered},
    {"way clear", Quantity::kLength, NeededBy::kWay, false, kToldAsNotCovered},
});

bool Needs(NeededBy who, const Action& action, const Strategy* strategy) {
  const domain::ActionKind& kind = *action.kind;
  const bool is_by_hand = HoldIn(action) != nullptr;
  const bool mates = kind.leaves == domain::Leaves::kMated;
  const bool puts_down = is_by_hand && kind.leaves == domain::Leaves::kAtPlace;
  switch (who) {
    case NeededBy::kGrasp:
      return kind.ClosesPads();
    case NeededBy::kCarrying:
      return is_by_hand && kind.leaves != domain::Leaves::kWhereItWas;
    case NeededBy::kHandWork:
      return is_by_hand;
    case NeededBy::kWay:
      return true;
    case NeededBy::kPutdown:
      return puts_down;
    case NeededBy::kRelease:
      return puts_down || mates;
    case NeededBy::kMating:
      return mates;
    case NeededBy::kStrategy:
      return mates && strategy != nullptr;
  }
  ASSAY_CHECK(false, "who needs a condition is none that the switch knows");
  return false;
}

bool Has(const std::vector<CertifiedPrecondition>& preconditions, std::string_view condition) {
  return std::ranges::find(preconditions, condition, &CertifiedPrecondition::condition) !=
         preconditions.end();
}

// Compares one step's certificate with the table.
class Coverage {
 public:
  explicit Coverage(const PlannedStep& step)
      : certificate_(step.certificate),
        needed_(KindsNeeded(step.action, step.strategy ? &*step.strategy : nullptr)) {}

  std::vector<std::string> Flaws() {
    for (const ConditionKind* kind : needed_) CheckKind(*kind);
    for (const CertifiedPrecondition& claim : certificate_.preconditions) {
      CheckIsNeeded(claim.condition);
    }
    for (const NotNeeded& lacking : certificate_.not_needed) CheckIsNeeded(lacking.condition);
    return std::move(flaws_);
  }

 private:
  void CheckKind(const ConditionKind& kind) {
    const bool is_there = Has(certificate_.preconditions, kind.name);
    const auto& reasons = certificate_.not_needed;
    const auto reason = std::ranges::find(reasons, kind.name, &NotNeeded::condition);
    if (reason == reasons.end()) {
      if (!is_there) Add("the certificate covers no '{}', which such a step needs", kind.name);
      return;
    }
    if (is_there)
      Add("the certificate both claims '{0}' and says that '{0}' is not needed", kind.name);
    const bool is_of_paper = !kind.is_published && reason->reason == kNotPublished;
    if (is_of_paper || (!kind.may_lack.empty() && reason->reason == kind.may_lack)) return;
    Add("\"{}\" is not a valid reason to leave out '{}'", reason->reason, kind.name);
  }

  void CheckIsNeeded(const std::string& condition) {
    if (std::ranges::count(needed_, condition, &ConditionKind::name) > 0) return;
    Add("'{}' is no condition of such a step", condition);
  }

  // Adds a flaw once, however many preconditions of the kind there are.
  template <class... Values>
  void Add(fmt::format_string<Values...> text, Values&&... values) {
    std::string flaw = fmt::format(text, std::forward<Values>(values)...);
    if (std::ranges::count(flaws_, flaw) == 0) flaws_.push_back(std::move(flaw));
  }

  const Certificate& certificate_;
  const std::vector<const ConditionKind*> needed_;
  std::vector<std::string> flaws_;
};

}  // namespace

std::span<const ConditionKind> ConditionKinds() { return kKinds; }

const ConditionKind* FindConditionKind(std::string_view name) {
  const auto found = std::ranges::find(kKinds, name, &ConditionKind::name);
  return found == kKinds.end() ? nullptr : &*found;
}

Quantity QuantityOf(std::string_view condition) {
  const ConditionKind* kind = FindConditionKind(condition);
  ASSAY_CHECK(kind != nullptr, "there is no condition '{}'", condition);
  return kind->quantity;
}

bool IsAsPublished(const Plan& plan) {
  return std::ranges::any_of(plan.steps, [](const PlannedStep& step) {
    return std::ranges::count(step.certificate.not_needed, kNotPublished, &NotNeeded::reason) > 0;
  });
}

std::vector<const ConditionKind*> KindsNeeded(const Action& action, const Strategy* strategy) {
  std::vector<const ConditionKind*> needed;
  for (const ConditionKind& kind : kKinds) {
    if (Needs(kind.needed_by, action, strategy)) needed.push_back(&kind);
  }
  return needed;
}

std::vector<NotNeeded> NotNeededIn(const std::vector<CertifiedPrecondition>& preconditions,
                                   const Action& action, const Strategy* strategy,
                                   bool as_published) {
  const std::vector<const ConditionKind*> needed = KindsNeeded(action, strategy);
  for (const CertifiedPrecondition& claim : preconditions) {
    ASSAY_CHECK(std::ranges::count(needed, claim.condition, &ConditionKind::name) > 0,
                "the table of conditions has no '{}' for such an action", claim.condition);
  }
  std::vector<NotNeeded> lacking;
  for (const ConditionKind* kind : needed) {
    if (Has(preconditions, kind->name)) continue;
    const std::string_view reason =
        as_published && !kind->is_published ? kNotPublished : kind->may_lack;
    ASSAY_CHECK(!reason.empty(), "nothing was asked of '{}'", kind->name);
    lacking.push_back({std::string(kind->name), std::string(reason)});
  }
  return lacking;
}

std::vector<std::string> FlawsOfCoverage(const PlannedStep& step) { return Coverage(step).Flaws(); }

}  // namespace assay::plan
