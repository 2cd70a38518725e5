#include "planner/constraint_posting/uncertainty_phase/augmentation/augmented_steps.h"

#include <algorithm>

#include "planner/constraint_posting/uncertainty_phase/unproved_goals.h"

namespace assay::constraint_posting {

using uncertainty::MomentId;
using uncertainty::Unproved;
using uncertainty::WorldTree;

std::vector<Unproved> AugmentedStep::Unabsorbed(std::vector<Unproved> unproved) const {
  return WithoutConditions(absorbed, std::move(unproved));
}

bool AugmentedStep::IsProved(WorldTree& tree, MomentId after) const {
  if (absorbed.empty()) return tree.IsProved(after);
  return Unabsorbed(tree.UnprovedAt(after)).empty();
}

Measure& AugmentedStep::Note(const std::string& resolver, const Unmet& unmet) {
  const auto known = std::ranges::find(measures, resolver, &Measure::resolver);
  if (known != measures.end()) return *known;
  return measures.emplace_back(Measure{.resolver = resolver, .because = unmet});
}

void AugmentedStep::GiveUp(const Unmet& unmet) {
  given_up = true;
  strategy.reset();
  absorbed.clear();
  Note(std::string(kVerification), unmet);
}

int AugmentedSteps::InsertedBefore(int step) const {
  return static_cast<int>(
      std::count_if(steps_.begin(), steps_.begin() + step,
                    [&](const AugmentedStep& before) { return IsInserted(before); }));
}

plan::StepId AugmentedSteps::NextId() const {
  return plan::StepId(of_instance_ + static_cast<std::size_t>(InsertedBefore(size())));
}

MomentId AugmentedSteps::MomentAfter(int step, WorldTree& tree) const {
  MomentId moment = tree.Beginning();
  for (int i = 0; i <= step; ++i) moment = tree.After(moment, steps_[i].action, steps_[i].way());
  return moment;
}

MomentId AugmentedSteps::MomentAfter(int step, BestKnown& best) const {
  MomentId moment = best.Beginning();
  for (int i = 0; i <= step; ++i) {
    if (!IsInserted(steps_[i])) moment = best.After(moment, steps_[i].action, steps_[i].way());
  }
  return moment;
}

}  // namespace assay::constraint_posting
