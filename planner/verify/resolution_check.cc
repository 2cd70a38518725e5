#include "planner/verify/resolution_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "planner/constraint_posting/uncertainty_phase/augmentation/augmented_steps.h"
#include "planner/constraint_posting/uncertainty_phase/unproved_goals.h"
#include "planner/uncertainty/preconditions/certify.h"
#include "planner/verify/certificate_check.h"

namespace assay::verify {
namespace {

using plan::Flaw;
using plan::PlannedStep;
using plan::Resolution;
using plan::StepId;

constexpr std::string_view kMoving = "moving";
constexpr std::string_view kSensing = "sensing";
constexpr std::string_view kSqueezing = "squeezing";
constexpr std::string_view kFineMotion = "fine-motion";
constexpr std::string_view kVerification = constraint_posting::kVerification;

bool IsLook(const plan::Action& action) { return action.Is(domain::kSense); }
bool IsSqueeze(const plan::Action& action) { return action.Is(domain::kSqueeze); }

// Returns whether the resolver may have inserted these actions, or moved parts by them.
bool Makes(std::string_view resolver, const std::vector<plan::Action>& actions) {
  const auto looks = std::ranges::count_if(actions, IsLook);
  const auto squeezes = std::ranges::count_if(actions, IsSqueeze);
  const std::ptrdiff_t others = std::ssize(actions) - looks - squeezes;
  if (resolver == kSensing) return looks > 0 && squeezes == 0 && others == 0;
  if (resolver == kSqueezing) return squeezes > 0 && others == 0;
  if (resolver == kFineMotion) return squeezes == 0 && others == 0;
  if (resolver == kVerification) return actions.empty();
  return resolver == kMoving && others > 0 && looks == 0 && squeezes == 0;
}

bool AreSameNumbers(const std::string& a, const std::string& b) {
  constexpr double kRoundedDigits = 2e-3;  // of numbers that are written with four digits
  char* end_of_a = nullptr;
  char* end_of_b = nullptr;
  const double of_a = std::strtod(a.c_str(), &end_of_a);
  const double of_b = std::strtod(b.c_str(), &end_of_b);
  return end_of_a != a.c_str() && end_of_b != b.c_str() &&
         std::string_view(end_of_a) == std::string_view(end_of_b) &&
         std::abs(of_a - of_b) <= kRoundedDigits * std::max(std::abs(of_a), std::abs(of_b));
}

// Returns whether both texts have the same words, and numbers that differ at most by rounding.
bool SayTheSame(const std::string& a, const std::string& b) {
  std::istringstream words_of_a(a);
  std::istringstream words_of_b(b);
  std::string of_a, of_b;
  while (words_of_a >> of_a) {
    if (!(words_of_b >> of_b) || (of_a != of_b && !AreSameNumbers(of_a, of_b))) return false;
  }
  return !(words_of_b >> of_b);
}

class ResolutionCheck {
 public:
  ResolutionCheck(const domain::Problem& problem, const plan::Plan& plan,
                  uncertainty::Propagation propagation)
      : problem_(problem), plan_(plan), propagation_(propagation) {}

  std::vector<Flaw> Run() {
    for (const StepId id : plan_.ExecutionOrder()) {
      step_ = id;
      CheckWays();
      for (const Resolution& resolution : ResolutionsOf(id)) {
        if (CheckSteps(resolution)) CheckReason(resolution);
      }
    }
    for (const StepId id : plan_.ExecutionOrder()) {
      step_ = id;
      CheckMaker();
    }
    return std::move(flaws_);
  }

 private:
  const std::vector<Resolution>& ResolutionsOf(StepId id) const {
    return plan_.step(id).certificate.resolutions;
  }

  void Add(std::string what) { flaws_.push_back({step_, "certificate.resolutions: " + what}); }

  std::ptrdiff_t Count(std::string_view resolver) const {
    return std::ranges::count(ResolutionsOf(step_), resolver, &Resolution::resolver);
  }

  void CheckWays() {
    const PlannedStep& step = plan_.step(step_);
    for (const Resolution& resolution : step.certificate.resolutions) {
      if (Count(resolution.resolver) > 1) Add(resolution.resolver + " is there more than once");
    }
    if (Count(kVerification) != (IsUnproved(step) ? 1 : 0)) {
      Add(IsUnproved(step) ? "the step is not proved, and verification is missing"
                           : "the step is proved, and needs no verification");
    }
    if (Count(kFineMotion) != (step.strategy ? 1 : 0)) {
      Add(step.strategy ? "the step has a strategy, and fine-motion is missing"
                        : "fine-motion without a strategy");
    }
  }

  bool CheckSteps(const Resolution& resolution) {
    std::vector<plan::Action> actions;
    bool are_before = true;
    for (const StepId id : resolution.steps) {
      actions.push_back(plan_.step(id).action);
      are_before = are_before && plan_.step(id).executed < plan_.step(step_).executed;
    }
    const bool is_right = are_before && Makes(resolution.resolver, actions);
    if (!is_right) Add(fmt::format("'{}' does not insert these steps", resolution.resolver));
    return is_right;
  }

  void CheckReason(const Resolution& resolution) {
    if (resolution.resolver == kMoving) {
      if (!resolution.why.starts_with("not proved that ")) Add("a reason for moving is missing");
      return;
    }
    const std::optional<std::string> why = Why();
    if (!why) return Add(resolution.resolver + " is not needed: all is proved without it");
    std::string given = resolution.why;
    if (resolution.resolver == kSqueezing) given = given.substr(0, given.find("; after "));
    if (!SayTheSame(given, *why)) {
      Add(fmt::format("{}, because '{}' in the file, '{}' computed anew", resolution.resolver,
                      given, *why));
    }
  }

  // Returns the goal of the step that failed most when its remedies were sought; none if all goals
  // were proved.
  std::optional<std::string> Why() const {
    const std::vector<StepId> later = InsertedLater();
    uncertainty::UncertainWorld world(problem_, propagation_);
    for (const StepId id : plan_.ExecutionOrder()) {
      const PlannedStep& step = plan_.step(id);
      if (id == step_) break;
      if (std::ranges::count(later, id) > 0) continue;
      Propagate(world, step.action, step.strategy ? &*step.strategy : nullptr);
    }
    const std::vector<uncertainty::Unproved> unproved =
        DecideStep(world, plan_.step(step_).action, {}, uncertainty::Wanted::kAllUnproved);
    if (unproved.empty()) return std::nullopt;
    const auto margin = [](const uncertainty::Unproved& goal) { return goal.claim.margin; };
    return constraint_posting::WhyUnproved(
        AsCertified(*std::ranges::min_element(unproved, {}, margin), world, {}).claim);
  }

  // Returns the looks and squeezes that were inserted for this step and for later ones. Steps get
  // their remedies in the order of execution.
  std::vector<StepId> InsertedLater() const {
    std::vector<StepId> later;
    for (const StepId id : plan_.ExecutionOrder()) {
      if (plan_.step(id).executed < plan_.step(step_).executed) continue;
      for (const Resolution& resolution : ResolutionsOf(id)) {
        if (resolution.resolver == kMoving) continue;
        later.insert(later.end(), resolution.steps.begin(), resolution.steps.end());
      }
    }
    return later;
  }

  // A look or squeeze is there for one step only.
  void CheckMaker() {
    const plan::Action& action = plan_.step(step_).action;
    if (!IsLook(action) && !IsSqueeze(action)) return;
    std::ptrdiff_t makers = 0;
    for (const PlannedStep& step : plan_.steps) {
      for (const Resolution& resolution : step.certificate.resolutions) {
        makers += std::ranges::count(resolution.steps, step_);
      }
    }
    if (makers != 1) {
      Add(fmt::format("this step is inserted by {} resolutions in place of one", makers));
    }
  }

  const domain::Problem& problem_;
  const plan::Plan& plan_;
  const uncertainty::Propagation propagation_;
  StepId step_;
  std::vector<Flaw> flaws_;
};

}  // namespace

std::vector<Flaw> FlawsOfResolutions(const domain::Problem& problem, const plan::Plan& plan,
                                     uncertainty::Propagation propagation) {
  return ResolutionCheck(problem, plan, propagation).Run();
}

}  // namespace assay::verify
