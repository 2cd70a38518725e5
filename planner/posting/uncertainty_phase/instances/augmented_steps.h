#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/plan/data/plan.h"
#include "planner/posting/uncertainty_phase/instances/best_known.h"
#include "planner/uncertainty/errors/world_tree.h"

namespace assay::posting {

// Goals of a step that were not proved as it was then to be executed.
struct Unmet {
  uncertainty::MomentId after;
  std::vector<std::string> absorbed;  // conditions that were taken care of

  bool operator==(const Unmet&) const = default;
};

// A resolution whose reasons are put in words where the plan is written out.
struct Measure {
  std::string resolver;
  std::vector<plan::StepId> steps = {};  // that it inserted, in the order of execution
  Unmet because;
  // That parts are moved is explained: with the best that does without, something is still unmet.
  struct WithoutMoving {
    std::string resolver;
    Unmet still;
  };
  std::optional<WithoutMoving> without_moving = {};
};

// One step of a plan instance as it is augmented.
struct AugmentedStep {
  plan::StepId id;
  plan::Action action;
  std::vector<Measure> measures = {};
  std::vector<std::string> absorbed = {};  // conditions that a remedy takes care of
  std::optional<plan::Strategy> strategy = {};
  bool given_up = false;  // its goals cannot all be proved
  uncertainty::MomentId failed =
      uncertainty::MomentId::None();  // the moment after it, if they are not

  const plan::Strategy* way() const { return strategy ? &*strategy : nullptr; }
  bool fails() const { return !failed.IsNone(); }
  // The unproved goals that no remedy has taken upon itself.
  std::vector<uncertainty::Unproved> Unabsorbed(std::vector<uncertainty::Unproved> unproved) const;
  bool IsProved(uncertainty::WorldTree& tree, uncertainty::MomentId after) const;

  // The measure by this resolver, a new one if there is none.
  Measure& Note(const std::string& resolver, const Unmet& unmet);
  // Nothing more is done about it than to see whether it went well.
  void GiveUp(const Unmet& unmet);
};

// The steps of a plan instance and what is inserted, in the order of execution.
class AugmentedSteps {
 public:
  // No step yet, of an instance of so many: ids from there on are those of inserted steps.
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
  // Of the step that is inserted next.
  plan::StepId NextId() const;

  uncertainty::MomentId MomentAfter(int step, uncertainty::WorldTree& tree) const;
  // With the best known, so that nothing need be inserted.
  uncertainty::MomentId MomentAfter(int step, BestKnown& best) const;

 private:
  std::size_t of_instance_;
  std::vector<AugmentedStep> steps_;
};

}  // namespace assay::posting
