#include "planner/constraint_posting/uncertainty_phase/augmentation/augmented_steps.h"

#include <algorithm>

#include "planner/constraint_posting/uncertainty_phase/unproved_goals.h"

namespace assay::constraint_posting {

using uncertainty::SnapshotId;
using uncertainty::Unproved;
using uncertainty::WorldTree;

std::vector<Unproved> AugmentedStep::Unabsorbed(std::vector<Unproved> unproved) const {
  return WithoutConditions(absorbed, std::move(unproved));
}

bool AugmentedStep::IsProved(WorldTree& tree, SnapshotId after) const {
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

SnapshotId AugmentedSteps::SnapshotAfter(int step, WorldTree& tree) const {
  SnapshotId snapshot = tree.Beginning();
  for (int i = 0; i <= step; ++i)
    snapshot = tree.After(snapshot, steps_[i].action, steps_[i].way());
  return snapshot;
}

SnapshotId AugmentedSteps::SnapshotAfter(int step, BestKnown& best) const {
  SnapshotId snapshot = best.Beginning();
  for (int i = 0; i <= step; ++i) {
    if (!IsInserted(steps_[i])) snapshot = best.After(snapshot, steps_[i].action, steps_[i].way());
  }
  return snapshot;
}

}  // namespace assay::constraint_posting
