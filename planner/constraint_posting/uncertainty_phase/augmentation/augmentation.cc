#include "planner/constraint_posting/uncertainty_phase/augmentation/augmentation.h"

#include <algorithm>

#include "planner/constraint_posting/uncertainty_phase/remedy_search.h"
#include "planner/constraint_posting/uncertainty_phase/unproved_goals.h"

namespace assay::constraint_posting {

using domain::PartId;
using uncertainty::SnapshotId;
using uncertainty::UncertainWorld;
using uncertainty::Unproved;

namespace {

void AddInTheWay(PartId part, std::string why, Objection& objection) {
  const auto is_known = std::ranges::count(objection.in_the_way, part, &PartInTheWay::part) > 0;
  if (!is_known) objection.in_the_way.push_back({part, std::move(why)});
}

// Completes the objection from the goals. The goal with the greatest violation comes first.
void Explain(std::vector<Unproved> goals, const UncertainWorld& world, Objection& objection) {
  std::ranges::stable_sort(goals, {}, [](const Unproved& goal) { return goal.claim.margin; });
  objection.why = WhyUnproved(goals.front().claim);
  objection.place = std::ranges::all_of(goals, DependsOnPlace);
  for (const PartId part : world.PartsIn(ExpressionsOf(goals))) {
    if (std::ranges::count(objection.parts, part) == 0) objection.parts.push_back(part);
  }
  if (!objection.place) return;  // the step would fail even without other parts
  for (const Unproved& goal : goals) {
    if (!goal.neighbour.IsNone()) AddInTheWay(goal.neighbour, WhyUnproved(goal.claim), objection);
  }
}

}  // namespace

Augmentation::Augmentation(UncertaintyTask& task, std::size_t steps) : task_(&task), steps_(steps) {
  for (const plan::Action& look : task.options.looks) {
    steps_.Add({.id = steps_.NextId(), .action = look});
  }
}

Augmentation::Augmentation(UncertaintyTask& task, const plan::Plan& instance)
    : Augmentation(task, instance.steps.size()) {
  for (const plan::StepId id : instance.ExecutionOrder()) {
    Add(id, instance.step(id).action, IfUnproved::kPrepare);
  }
}

bool Augmentation::Add(plan::StepId id, const plan::Action& action, IfUnproved if_unproved) {
  if_unproved_ = if_unproved;
  steps_.Add({.id = id, .action = action});
  while (!DecideInOrder()) {
  }
  return !steps_.last().fails();
}

// Returns false if a remedy was inserted, so all steps must be decided again.
bool Augmentation::DecideInOrder() {
  SnapshotId snapshot = task_->possible.Beginning();
  for (int i = 0; i < steps_.size(); ++i) {
    AugmentedStep& step = steps_[i];
    snapshot = task_->possible.After(snapshot, step.action, step.way());
    step.failed = SnapshotId::None();
    if (step.Unabsorbed(task_->possible.UnprovedAt(snapshot)).empty()) continue;
    if (!step.given_up && Mend(i, {snapshot, step.absorbed})) return false;
    steps_[i].failed = snapshot;
  }
  return true;
}

// Returns true if remedies were applied. If none prove all the step's goals, the step is given up,
// and only the remedies that bring it nearest without moving parts are applied.
bool Augmentation::Mend(int step, const Unmet& unmet) {
  obstacles_.clear();
  const auto goals = WithoutConditions(unmet.absorbed, task_->possible.UnprovedAt(unmet.after));
  if (if_unproved_ == IfUnproved::kObjectAtOnce && std::ranges::any_of(goals, DependsOnPlace)) {
    steps_[step].GiveUp(unmet);
    return false;
  }
  const bool prepares = if_unproved_ == IfUnproved::kPrepare;
  RemedySearch search(
      *task_, steps_, step, unmet,
      prepares ? RemedySearch::Obstacles::kIgnored : RemedySearch::Obstacles::kNoted);
  std::optional<RemedySearch::Mended> mended = search.Proving();
  const bool is_proved = mended.has_value();
  if (!is_proved && prepares) mended = search.Nearing();
  combinations_ += search.combinations();
  obstacles_ = search.obstacles();
  if (mended) {
    steps_ = std::move(mended->steps);
    step = mended->step;
  }
  if (!is_proved) steps_[step].GiveUp(unmet);
  return mended.has_value();
}

Objection Augmentation::ObjectionToLast() const {
  const int step = steps_.size() - 1;
  const auto unmet = UnmetWhateverIsKnown(step);
  const UncertainWorld& world =
      unmet.empty() ? task_->possible.WorldAt(steps_[step].failed)
                    : task_->best->WorldAt(steps_.SnapshotAfter(step, *task_->best));
  Objection objection = {.action = step - steps_.InsertedBefore(step),
                         .parts = plan::PartsOf(task_->problem, steps_[step].action),
                         .history = unmet.empty()};
  Explain(unmet.empty() ? GoalsUnproved(step) : unmet, world, objection);
  if (unmet.empty()) AddObstaclesOfRemedies(objection);
  return objection;
}

std::vector<Unproved> Augmentation::GoalsUnproved(int step) const {
  return steps_[step].Unabsorbed(task_->possible.UnprovedAt(steps_[step].failed));
}

// Returns the goals of a step that fail with any knowledge from remedies. If some of these fail
// wherever parts are, only those are returned. The result is empty if remedies may prove the step.
std::vector<Unproved> Augmentation::UnmetWhateverIsKnown(int step) const {
  if (!task_->best) return {};
  std::vector<Unproved> unmet = task_->best->UnprovedAt(steps_.SnapshotAfter(step, *task_->best),
                                                        task_->options.Absorbable());
  if (!std::ranges::all_of(unmet, DependsOnPlace)) std::erase_if(unmet, DependsOnPlace);
  return unmet;
}

// Adds the parts beside which remedies cannot be executed or cannot be proved.
void Augmentation::AddObstaclesOfRemedies(Objection& objection) const {
  for (const PartId part : obstacles_) {
    if (std::ranges::count(objection.parts, part) > 0) continue;
    AddInTheWay(part, objection.why, objection);
    objection.place = true;
  }
}

std::vector<Subject> Augmentation::FailingAnywhere() const {
  std::vector<Subject> failing;
  for (int i = 0; i < steps_.size(); ++i) {
    if (!steps_[i].fails() || std::ranges::any_of(GoalsUnproved(i), DependsOnPlace)) continue;
    failing.push_back(SubjectOf(task_->problem, steps_[i].action));
  }
  return failing;
}

Standing Augmentation::standing() const {
  Standing standing = {.actions = steps_.of_instance()};
  for (int i = 0; i < steps_.size(); ++i) {
    if (!steps_[i].fails()) continue;
    ++standing.errors;
    standing.violation += ShortfallOf(GoalsUnproved(i)).violation;
  }
  return standing;
}

}  // namespace assay::constraint_posting
