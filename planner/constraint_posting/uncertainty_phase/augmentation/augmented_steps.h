#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/constraint_posting/uncertainty_phase/augmentation/best_known.h"
#include "planner/plan/data/plan.h"
#include "planner/uncertainty/error_sets/world_tree.h"

namespace assay::constraint_posting {

// The unproved goals of a step, stored as the snapshot after the step. The snapshot keeps the
// execution of the step that was planned when the goals were found.
struct Unmet {
  uncertainty::SnapshotId after;
  std::vector<plan::Condition> absorbed;  // conditions that remedies absorbed

  bool operator==(const Unmet&) const = default;
};

// The resolver's name for a step whose goals no remedy proves: the success of the step is verified.
inline constexpr std::string_view kVerification = "verification";

// A resolution whose reasons are put into words when the plan is written out.
struct Measure {
  std::string resolver;
  std::vector<plan::StepId> steps = {};  // the inserted steps, in the order of execution
  Unmet because;
  // The reason for moving parts: the goals that are still unmet with the best remedies that move no
  // part.
  struct WithoutMoving {
    std::string resolver;
    Unmet still;
  };
  std::optional<WithoutMoving> without_moving = {};
};

// One step of a plan instance during its augmentation.
struct AugmentedStep {
  plan::StepId id;
  plan::Action action;
  std::vector<Measure> measures = {};
  std::vector<plan::Condition> absorbed = {};  // conditions that a remedy absorbs
  std::optional<plan::Strategy> strategy = {};
  bool given_up = false;  // true if its goals cannot all be proved
  // the snapshot after the step if goals are unproved
  uncertainty::SnapshotId failed = uncertainty::SnapshotId::None();

  const plan::Strategy* way() const { return strategy ? &*strategy : nullptr; }
  bool fails() const { return !failed.IsNone(); }
  // Returns the unproved goals that no remedy absorbs.
  std::vector<uncertainty::Unproved> Unabsorbed(std::vector<uncertainty::Unproved> unproved) const;
  bool IsProved(uncertainty::WorldTree& tree, uncertainty::SnapshotId after) const;

  // Returns the measure of this resolver, or a new one if there is none.
  Measure& Note(const std::string& resolver, const Unmet& unmet);
  // Records that only verification remains for this step.
  void GiveUp(const Unmet& unmet);
};

// The steps of a plan instance and the inserted steps, in the order of execution.
class AugmentedSteps {
 public:
  // Makes an empty list for an instance of `of_instance` steps. Inserted steps have ids from
  // `of_instance` on.
  explicit AugmentedSteps(std::size_t of_instance) : of_instance_(of_instance) {}

  int size() const { return static_cast<int>(steps_.size()); }
  const AugmentedStep& operator[](int step) const { return steps_[step]; }
  AugmentedStep& operator[](int step) { return steps_[step]; }
  auto begin() const { return steps_.begin(); }
  auto end() const { return steps_.end(); }
  const AugmentedStep& last() const { return steps_.back(); }
  std::size_t of_instance() const { return of_instance_; }

  void Add(AugmentedStep step) { steps_.push_back(std::move(step)); }
  AugmentedSteps WithoutAny() const { return AugmentedSteps(of_instance_); }

  bool IsInserted(const AugmentedStep& step) const {
    return step.id.index() >= static_cast<int>(of_instance_);
  }
  int InsertedBefore(int step) const;
  // the id of the next inserted step
  plan::StepId NextId() const;

  uncertainty::SnapshotId SnapshotAfter(int step, uncertainty::WorldTree& tree) const;
  // Returns the snapshot with the best knowledge, for which nothing need be inserted.
  uncertainty::SnapshotId SnapshotAfter(int step, BestKnown& best) const;

 private:
  std::size_t of_instance_;
  std::vector<AugmentedStep> steps_;
};

}  // namespace assay::constraint_posting
