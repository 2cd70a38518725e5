#include "planner/plan/certificates/coverage.h"

#include <fmt/format.h>

#include <algorithm>

#include "planner/base/check.h"

namespace assay::plan {
namespace {

bool Has(const std::vector<CertifiedPrecondition>& preconditions, Condition condition) {
  return std::ranges::find(preconditions, condition, &CertifiedPrecondition::condition) !=
         preconditions.end();
}

// Compares one step's certificate with a list of kinds.
class Coverage {
 public:
  Coverage(const PlannedStep& step, ConditionKinds kinds)
      : certificate_(step.certificate),
        needed_(ConditionsNeeded(step.action, step.strategy ? &*step.strategy : nullptr, kinds)) {}

  std::vector<std::string> Flaws() {
    for (const Condition needed : needed_) Check(needed);
    for (const CertifiedPrecondition& claim : certificate_.preconditions) {
      CheckIsNeeded(claim.condition);
    }
    for (const NotNeeded& lacking : certificate_.not_needed) CheckIsNeeded(lacking.condition);
    return std::move(flaws_);
  }

 private:
  void Check(Condition needed) {
    const bool is_there = Has(certificate_.preconditions, needed);
    const auto& reasons = certificate_.not_needed;
    const auto reason = std::ranges::find(reasons, needed, &NotNeeded::condition);
    if (reason == reasons.end()) {
      if (!is_there) Add("the certificate covers no '{}', which such a step needs", needed.name());
      return;
    }
    if (is_there) {
      Add("the certificate both claims '{0}' and says that '{0}' is not needed", needed.name());
    }
    const bool is_of_paper = !needed->is_published() && reason->reason == kNotPublished;
    if (is_of_paper || (!needed->may_lack.empty() && reason->reason == needed->may_lack)) return;
    Add("\"{}\" is not a valid reason to leave out '{}'", reason->reason, needed.name());
  }

  void CheckIsNeeded(Condition condition) {
    if (std::ranges::count(needed_, condition) > 0) return;
    Add("'{}' is no condition of such a step", condition.name());
  }

  // Adds a flaw once, however many preconditions of the kind there are.
  template <class... Values>
  void Add(fmt::format_string<Values...> text, Values&&... values) {
    std::string flaw = fmt::format(text, std::forward<Values>(values)...);
    if (std::ranges::count(flaws_, flaw) == 0) flaws_.push_back(std::move(flaw));
  }

  const Certificate& certificate_;
  const std::vector<Condition> needed_;
  std::vector<std::string> flaws_;
};

}  // namespace

bool IsAsPublished(const Plan& plan) {
  return std::ranges::any_of(plan.steps, [](const PlannedStep& step) {
    return std::ranges::count(step.certificate.not_needed, kNotPublished, &NotNeeded::reason) > 0;
  });
}

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

std::vector<Condition> ConditionsNeeded(const Action& action, const Strategy* strategy,
                                        ConditionKinds kinds) {
  std::vector<Condition> needed;
  for (const ConditionKind* kind : kinds) {
    if (Needs(kind->needed_by, action, strategy)) needed.emplace_back(*kind);
  }
  return needed;
}

std::vector<NotNeeded> NotNeededIn(const std::vector<CertifiedPrecondition>& preconditions,
                                   const Action& action, const Strategy* strategy,
                                   bool as_published, ConditionKinds kinds) {
  const std::vector<Condition> needed = ConditionsNeeded(action, strategy, kinds);
  for (const CertifiedPrecondition& claim : preconditions) {
    ASSAY_CHECK(std::ranges::count(needed, claim.condition) > 0,
                "such an action does not need the condition '{}'", claim.condition.name());
  }
  std::vector<NotNeeded> lacking;
  for (const Condition condition : needed) {
    if (Has(preconditions, condition)) continue;
    const std::string_view reason =
        as_published && !condition->is_published() ? kNotPublished : condition->may_lack;
    ASSAY_CHECK(!reason.empty(), "nothing was asked of '{}'", condition.name());
    lacking.push_back({condition, std::string(reason)});
  }
  return lacking;
}

std::vector<std::string> FlawsOfCoverage(const PlannedStep& step, ConditionKinds kinds) {
  return Coverage(step, kinds).Flaws();
}

}  // namespace assay::plan
