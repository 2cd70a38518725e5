#pragma once

#include <compare>
#include <cstdint>
#include <set>
#include <vector>

#include "planner/plan/data/plan.h"
#include "planner/posting/objection.h"
#include "planner/posting/uncertainty_phase/instances/augmented_steps.h"
#include "planner/posting/uncertainty_phase/subject.h"
#include "planner/posting/uncertainty_phase/uncertainty_task.h"

namespace assay::posting {

// How an augmented plan instance compares with others; less is better.
struct Standing {
  int errors = 0;
  std::size_t actions = 0;  // of the first phase
  double violation = 0;     // metres and radians

  auto operator<=>(const Standing&) const = default;
};

// What is done about a step that cannot be proved.
enum class IfUnproved {
  kPrepare,       // it is brought nearer to being proved, and its failure is prepared for
  kObject,        // nothing: it is only told why
  kObjectAtOnce,  // and remedies are not even tried where it matters where parts are
};

// A plan instance with what is inserted, one step after another in the order of execution. Decides
// only what is proved; the certificates are written for the instance that is kept.
class Augmentation {
 public:
  // No step yet, of an instance of so many.
  Augmentation(UncertaintyTask& task, std::size_t steps);
  // With all steps of the instance added, and failures prepared for.
  Augmentation(UncertaintyTask& task, const plan::Plan& instance);

  // Whether all goals of the step are proved, with what is then inserted.
  bool Add(plan::StepId id, const plan::Action& action, IfUnproved if_unproved);

  // To the step that was added last, which is not proved. If it fails even with the best known, by
  // what fails then; and if of that not all depends on where parts are, by the rest.
  Objection ObjectionToLast() const;
  // What the steps are about that are not proved wherever parts are.
  std::vector<Subject> FailingAnywhere() const;

  const AugmentedSteps& steps() const { return steps_; }
  Standing standing() const;
  std::int64_t combinations() const { return combinations_; }  // of remedies that were tried

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
  std::set<domain::PartId> obstacles_ = {};  // of the remedies for the step that was mended last
};

}  // namespace assay::posting
