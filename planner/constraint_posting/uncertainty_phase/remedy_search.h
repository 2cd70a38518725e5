#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "planner/constraint_posting/uncertainty_phase/augmentation/augmented_steps.h"
#include "planner/constraint_posting/uncertainty_phase/combinations.h"
#include "planner/constraint_posting/uncertainty_phase/shortfall.h"
#include "planner/constraint_posting/uncertainty_phase/uncertainty_task.h"

namespace assay::constraint_posting {

// Searches for remedies for one step of which not all goals are proved. It returns the fewest
// remedies that prove all goals of the step and keep the goals that are proved, with sensing first
// (Spar, "Satisfying Uncertainty-Reduction Goals"). Beyond the paper, remedies are inserted
// wherever their preconditions hold, not only right before the step, and a remedy may prepare the
// goals of another remedy.
class RemedySearch {
 public:
  // Says whether the search records the parts that are in the way of remedies.
  enum class Obstacles { kIgnored, kNoted };

  // All references must outlive the search.
  RemedySearch(UncertaintyTask& task, const AugmentedSteps& steps, int step, const Unmet& unmet,
               Obstacles noted);

  // The plan's steps, in which remedies are inserted.
  struct Mended {
    AugmentedSteps steps;
    int step = 0;  // the index of the step whose goals the remedies prove
  };

  // Returns the plan's steps with remedies inserted, such that all goals of the step for which the
  // search was made are proved. Strategies take long to find, so they are tried only where nothing
  // else proves the goals.
  std::optional<Mended> Proving();
  // Returns the plan's steps with those remedies inserted that bring the same step nearest to being
  // proved. Remedies that move parts are left out. It must be called after Proving.
  std::optional<Mended> Nearing();

  // the number of combinations that were tried to prove the step
  std::int64_t combinations() const { return combinations_; }
  // Returns the parts beside which remedies cannot be executed or cannot be proved.
  const std::set<domain::PartId>& obstacles() const { return obstacles_; }

 private:
  struct Candidate {
    int resolver = 0;  // index in the options
    Remedy remedy;
  };
  enum class Absorbing { kNo, kYes };

  bool MayBeProved(std::vector<plan::Condition> absorbable) const;
  std::vector<Candidate> Candidates(Absorbing absorbing);
  std::optional<Mended> ProvingRemedies(Absorbing absorbing);
  void NoteWhatFellShort(AugmentedStep& mended);
  bool Disturbs(const Measure& measure) const;
  std::vector<Combinable> Items() const;
  Mended With(const std::vector<int>& chosen) const;
  std::string NameOf(const Candidate& candidate) const;
  const Resolver& ResolverOf(int index) const { return *task_.options.resolvers[index]; }

  struct UnprovedStep {
    int step = 0;
    uncertainty::SnapshotId after;
  };
  std::optional<UnprovedStep> FirstUnproved(const Mended& mended) const;
  std::optional<Shortfall> ShortfallAfter(const Mended& mended) const;
  void NoteNeighbours(uncertainty::SnapshotId after);

  UncertaintyTask& task_;
  const AugmentedSteps& steps_;
  const int step_;
  const Unmet unmet_;
  const Obstacles noted_;
  std::vector<Candidate> candidates_ = {};
  std::int64_t combinations_ = 0;
  std::set<domain::PartId> obstacles_ = {};
};

}  // namespace assay::constraint_posting
