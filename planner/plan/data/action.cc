#include "planner/plan/data/action.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "planner/base/check.h"
#include "planner/domain/problem/problem.h"

namespace assay::plan {
namespace {

using domain::Argument;
using domain::Mating;
using domain::Problem;

enum class MatingText { kParts, kPartsAndFeatures };

std::string TextOf(const Problem& problem, const Mating& mating, MatingText extent) {
  std::string parts =
      fmt::format("{}, {}", problem.part(mating.held).name, problem.part(mating.fixed).name);
  if (extent == MatingText::kParts) return parts;
  std::vector<int> of_held, of_fixed;
  for (const auto& [held, fixed] : mating.features) {
    of_held.push_back(held.index());
    of_fixed.push_back(fixed.index());
  }
  return fmt::format("{}, [[{}], [{}]]", parts, fmt::join(of_held, ", "),
                     fmt::join(of_fixed, ", "));
}

std::string TextOf(const Problem& problem, const Action& action,
                   const std::vector<Argument>& arguments, MatingText extent) {
  return domain::Text(*action.kind, arguments, [&](Argument argument) -> std::string {
    switch (argument) {
      case Argument::kPart:
        return problem.part(action.part).name;
      case Argument::kMating:
        return TextOf(problem, problem.mating(action.mating), extent);
      case Argument::kGrasp:
        return action.hold.grasp;
      case Argument::kPosition:
        return action.place.position;
      case Argument::kSensor:
        return action.sensor;
    }
    return "";
  });
}

}  // namespace

PartId HandledPart(const Problem& problem, const Action& action) {
  return action.mating.IsNone() ? action.part : problem.mating(action.mating).held;
}

PartId FixedPart(const Problem& problem, const Action& action) {
  return action.mating.IsNone() ? PartId::None() : problem.mating(action.mating).fixed;
}

PartId PlacedPart(const Problem& problem, const Action& action) {
  return PartsOf(problem, action).back();
}

std::vector<PartId> PartsOf(const Problem& problem, const Action& action) {
  if (action.mating.IsNone()) return {action.part};
  const Mating& mating = problem.mating(action.mating);
  return {mating.held, mating.fixed};
}

const Hold* HoldIn(const Action& action) {
  return action.kind->Has(Argument::kGrasp) ? &action.hold : nullptr;
}

const Hold& HoldOf(const Action& action) {
  const Hold* hold = HoldIn(action);
  ASSAY_CHECK(hold != nullptr, "a look leaves no part in the hand");
  return *hold;
}

Pose HandledAt(const Problem& problem, const Action& action) {
  const Pose& X_WorldPart = action.place.X_WorldPart;
  if (action.mating.IsNone()) return X_WorldPart;
  return X_WorldPart * problem.mating(action.mating).X_FixedHeld;
}

std::string ShortText(const Problem& problem, const Action& action) {
  return TextOf(problem, action, action.kind->short_arguments, MatingText::kParts);
}

std::string FullText(const Problem& problem, const Action& action) {
  return TextOf(problem, action, action.kind->arguments, MatingText::kPartsAndFeatures);
}

}  // namespace assay::plan
