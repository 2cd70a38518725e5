#pragma once

#include <compare>
#include <cstdint>
#include <set>
#include <vector>

#include "planner/constraint_posting/objection.h"
#include "planner/constraint_posting/uncertainty_phase/augmentation/augmented_steps.h"
#include "planner/constraint_posting/uncertainty_phase/subject.h"
#include "planner/constraint_posting/uncertainty_phase/uncertainty_task.h"
#include "planner/plan/data/plan.h"

namespace assay::constraint_posting {

// The rank of an augmented plan instance among others; less is better.
struct Standing {
  int errors = 0;
  std::size_t actions = 0;  // the number of actions of the first phase
  double violation = 0;     // metres and radians

  auto operator<=>(const Standing&) const = default;
};

// The treatment of a step that cannot be proved.
enum class IfUnproved {
  // remedies bring it nearer to being proved, and verifications prepare for its failure
  kPrepare,
  kObject,  // nothing is inserted; an objection says why the step is not proved
  // like kObject, but no remedies are tried if an unproved goal depends on the places of parts
  kObjectAtOnce,
};

// A plan instance with inserted actions, extended one step after another in the order of execution.
// It decides only which steps are proved. Certificates are written later for the instance that is
// kept.
class Augmentation {
 public:
  // Makes an augmentation without steps, for an instance with `steps` steps.
  Augmentation(UncertaintyTask& task, std::size_t steps);
  // Adds all steps of the instance and prepares for their failures.
  Augmentation(UncertaintyTask& task, const plan::Plan& instance);

  // Adds a step with its remedies. Returns true if all goals of the step are proved.
  bool Add(plan::StepId id, const plan::Action& action, IfUnproved if_unproved);

  // Returns the objection to the step that was added last, which must be unproved. If some goals
  // fail even with the best knowledge, the objection names them. If any of these goals do not
  // depend on the places of parts, it names only the goals that do not.
  Objection ObjectionToLast() const;
  // Returns the subjects of the steps that are not proved wherever parts are.
  std::vector<Subject> FailingAnywhere() const;

  const AugmentedSteps& steps() const { return steps_; }
  Standing standing() const;
  // the number of combinations of remedies that were tried
  std::int64_t combinations() const { return combinations_; }

 private:
  bool DecideInOrder();
  bool Mend(int step, const Unmet& unmet);
  std::vector<uncertainty::Unproved> GoalsUnproved(int step) const;
  std::vector<uncertainty::Unproved> UnmetWhateverIsKnown(int step) const;
  void AddObstaclesOfRemedies(Objection& objection) const;

  UncertaintyTask* task_;
  AugmentedSteps steps_;
  IfUnproved if_unproved_ = IfUnproved::kPrepare;
  std::int64_t combinations_ = 0;
  // the parts in the way of remedies for the step that was mended last
  std::set<domain::PartId> obstacles_ = {};
};

}  // namespace assay::constraint_posting
