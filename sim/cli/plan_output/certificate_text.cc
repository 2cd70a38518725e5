#include "sim/cli/plan_output/certificate_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "planner/base/check.h"
#include "planner/base/counted.h"
#include "planner/plan/certificates/coverage.h"
#include "planner/plan/certificates/not_covered.h"
#include "sim/cli/options/quantity.h"

namespace assay::cli {
namespace {

using plan::CertifiedPrecondition;
using plan::StepId;

std::string RecoveryText(const plan::Plan& plan, StepId step, const std::string& error) {
  const auto found = std::ranges::find_if(plan.recoveries, [&](const plan::Recovery& recovery) {
    return recovery.step == step && recovery.error == error;
  });
  if (found == plan.recoveries.end()) return error;
  const std::string strategy =
      domain::RecoveryStrategyNames()[static_cast<std::size_t>(found->strategy)];
  if (found->strategy != domain::RecoveryStrategy::kGropingSearch) {
    return fmt::format("{} ({})", error, strategy);
  }
  return fmt::format("{} ({} within {})", error, strategy,
                     QuantityText(found->radius, kLengthUnit));
}

std::string VerificationText(const plan::Plan& plan, const plan::Verification& verification) {
  std::string text =
      fmt::format("    verification {}: the expected {} is {:.4g} +- {}", verification.name,
                  domain::MeasuredQuantityNames()[static_cast<std::size_t>(verification.quantity)],
                  verification.expected / kLengthUnit.factor,
                  QuantityText(verification.tolerance, kLengthUnit));
  if (!verification.below.empty()) {
    text += "; less means " + RecoveryText(plan, verification.step, verification.below);
  }
  if (!verification.above.empty()) {
    text += "; more means " + RecoveryText(plan, verification.step, verification.above);
  }
  return text + "\n";
}

constexpr char kSomeIsNotCovered[] = " No precondition covers the effects that are listed below.";

bool AnyStrategy(const plan::Plan& plan) {
  return std::ranges::any_of(
      plan.steps, [](const plan::PlannedStep& step) { return step.strategy.has_value(); });
}

// Returns the exception of the plan's summary, as the plan's page says it (sim/view/page/steps).
std::string ExceptWaysText(const plan::Plan& plan) {
  const std::vector<int> steps = plan::StepsWithUnprovedWays(plan);
  if (steps.empty()) return "";
  return fmt::format(", except for the arm's way in {} {}", steps.size() == 1 ? "step" : "steps",
                     fmt::join(steps, ", "));
}

// Returns what certificates leave open if they are computed as published.
std::string UnaskedText(const plan::Plan& plan) {
  if (!plan::IsAsPublished(plan)) return "";
  std::vector<std::string_view> unasked;
  for (const plan::ConditionKind* kind : plan::KnownConditions()) {
    if (!kind->is_published()) unasked.push_back(kind->name);
  }
  return fmt::format(" This propagation does not require: {}.", fmt::join(unasked, ", "));
}

// Returns the size of the errors that the strategy absorbs, and what would fail first.
std::string StrategyText(const plan::Strategy& strategy) {
  const plan::StrategyCertificate& certificate = strategy.certificate;
  const auto numbers = [](const geometry::Vector3& v, const Unit& unit) {
    const geometry::Vector3 scaled = v / unit.factor;
    return fmt::format("({:.3g}, {:.3g}, {:.3g}) {}", scaled.x(), scaled.y(), scaled.z(),
                       unit.name);
  };
  std::string text = fmt::format(
      "    {} by contacts, in spite of errors of the tip of {} and {}\n"
      "    certain for {:.2f} times these errors and friction up to {:.2f}",
      Counted(std::ssize(strategy.motions), "motion"), numbers(certificate.d, kLengthUnit),
      numbers(certificate.w, kAngleUnit), certificate.absorbed, certificate.friction);
  const plan::UnwantedContact* first = nullptr;
  for (const plan::StrategyMotion& motion : strategy.motions) {
    for (const plan::UnwantedContact& unwanted : motion.unwanted) {
      if (first == nullptr || unwanted.scale < first->scale) first = &unwanted;
    }
  }
  if (first == nullptr) return text + "\n";
  return text + fmt::format("; first unwanted {} {}, at {:g} times the errors\n",
                            first->is_loss ? "loss of the contact" : "contact:",
                            strategy.contacts[static_cast<std::size_t>(first->contact)].name,
                            first->scale);
}

}  // namespace

std::string CertificateText(const plan::PlannedStep& step) {
  const std::vector<CertifiedPrecondition>& preconditions = step.certificate.preconditions;
  const std::size_t all = preconditions.size();
  if (all == 0) return "";
  const std::size_t proved = std::ranges::count_if(preconditions, &CertifiedPrecondition::holds);
  if (proved == all) return fmt::format("{} proved", all);
  const std::size_t absorbed = std::ranges::count_if(preconditions, [&](const auto& claim) {
    return !claim.holds() && plan::Absorbs(step.strategy, claim.condition);
  });
  const std::string text = fmt::format("{} of {} proved", proved, all);
  return absorbed == 0 ? text : fmt::format("{}, {} absorbed", text, absorbed);
}

std::string NotCoveredText(const domain::Problem& problem, const plan::Plan& plan) {
  const std::vector<std::string> names = plan::NotCovered(problem, plan);
  if (names.empty()) return "";
  return fmt::format("not covered by any precondition:\n  - {}\n", fmt::join(names, "\n  - "));
}

std::string UncertaintyText(const domain::Problem& problem, const plan::Plan& plan) {
  const bool is_certified = std::ranges::any_of(
      plan.steps, [](const plan::PlannedStep& step) { return !step.certificate.before.empty(); });
  if (!is_certified) return "";
  std::string done;
  for (const StepId id : plan.ExecutionOrder()) {
    const std::string text = ResolutionsText(plan, id);
    if (!text.empty()) done += fmt::format("  for step {}: {}", plan.step(id).executed, text);
  }
  const std::string summary =
      plan.errors == 0
          ? fmt::format(
                "Every precondition{} is proved{}{}.{}{}",
                plan::IsAsPublished(plan) ? " of the paper" : "",
                AnyStrategy(plan) ? ", or absorbed by fine motion" : "", ExceptWaysText(plan),
                plan::NotCovered(problem, plan).empty() ? "" : kSomeIsNotCovered, UnaskedText(plan))
          : fmt::format("Some preconditions of {} are not proved. The plan has {} and {} for {}.",
                        Counted(plan.errors, "step"),
                        Counted(std::ssize(plan.verifications), "verification"),
                        Counted(std::ssize(plan.recoveries), "recovery", "recoveries"),
                        plan.errors == 1 ? "this step" : "these steps");
  const std::string text = done.empty() ? fmt::format("\n{} Nothing was inserted.\n", summary)
                                        : fmt::format("\nuncertainty\n{}{}\n", done, summary);
  return text + NotCoveredText(problem, plan);
}

std::string StepsText(const plan::Plan& plan, const std::vector<StepId>& steps) {
  std::vector<int> places;
  for (const StepId id : steps) places.push_back(plan.step(id).executed);
  std::ranges::sort(places);
  return fmt::format("{} {}", places.size() == 1 ? "step" : "steps", fmt::join(places, ", "));
}

std::string ResolutionsText(const plan::Plan& plan, StepId step) {
  std::string text;
  const std::vector<plan::Resolution>& resolutions = plan.step(step).certificate.resolutions;
  for (std::size_t i = 0; i < resolutions.size(); ++i) {
    text += resolutions[i].resolver;
    if (!resolutions[i].steps.empty()) {
      text += fmt::format(" ({})", StepsText(plan, resolutions[i].steps));
    }
    const bool same_reason =
        i + 1 < resolutions.size() && resolutions[i + 1].why == resolutions[i].why;
    text += same_reason ? ", " : fmt::format(", because\n    {}\n", resolutions[i].why);
  }
  if (plan.step(step).strategy) text += StrategyText(*plan.step(step).strategy);
  for (const plan::Verification& verification : plan.verifications) {
    if (verification.step == step) text += VerificationText(plan, verification);
  }
  return text;
}

}  // namespace assay::cli
