#include "planner/constraint_posting/uncertainty_phase/remedy_search.h"

#include <algorithm>
#include <iterator>

#include "planner/constraint_posting/uncertainty_phase/unproved_goals.h"

namespace assay::constraint_posting {

using domain::PartId;
using uncertainty::SnapshotId;
using uncertainty::Unproved;

RemedySearch::RemedySearch(UncertaintyTask& task, const AugmentedSteps& steps, int step,
                           const Unmet& unmet, Obstacles noted)
    : task_(task), steps_(steps), step_(step), unmet_(unmet), noted_(noted) {}

std::optional<RemedySearch::Mended> RemedySearch::Proving() {
  candidates_ = Candidates(Absorbing::kNo);
  std::optional<Mended> proving;
  if (MayBeProved({})) proving = ProvingRemedies(Absorbing::kNo);
  if (!proving && MayBeProved(task_.options.Absorbable())) {
    std::ranges::move(Candidates(Absorbing::kYes), std::back_inserter(candidates_));
    std::ranges::stable_sort(candidates_, {}, &Candidate::resolver);
    proving = ProvingRemedies(Absorbing::kYes);
  }
  if (proving) NoteWhatFellShort(proving->steps[proving->step]);
  return proving;
}

// Returns false if some goal fails even when x, y and theta of all resting parts are known, and no
// remedy makes this goal unnecessary. It is then useless to try remedies one by one.
bool RemedySearch::MayBeProved(std::vector<plan::Condition> absorbable) const {
  if (!task_.best) return true;
  const std::vector<plan::Condition>& absorbed = steps_[step_].absorbed;
  absorbable.insert(absorbable.end(), absorbed.begin(), absorbed.end());
  return task_.best->LeastShortfall(steps_.SnapshotAfter(step_, *task_.best), absorbable).goals ==
         0;
}

// Returns the remedies of the resolvers that may absorb errors, or the remedies of the other
// resolvers.
std::vector<RemedySearch::Candidate> RemedySearch::Candidates(Absorbing absorbing) {
  std::vector<plan::Action> actions;
  std::vector<std::optional<plan::Strategy>> strategies;
  for (const AugmentedStep& step : steps_) {
    actions.push_back(step.action);
    strategies.push_back(step.strategy);
  }
  UnmetGoals unmet = {task_.problem,
                      actions,
                      step_,
                      WithoutConditions(unmet_.absorbed, task_.possible.UnprovedAt(unmet_.after)),
                      {},
                      std::move(strategies)};
  unmet.parts = task_.possible.WorldAt(unmet_.after).PartsIn(ExpressionsOf(unmet.goals));
  std::vector<Candidate> candidates;
  for (int r = 0; r < std::ssize(task_.options.resolvers); ++r) {
    Resolver& resolver = *task_.options.resolvers[r];
    if (resolver.absorbs().empty() == (absorbing == Absorbing::kYes)) continue;
    for (Remedy& remedy : resolver.Propose(unmet)) candidates.push_back({r, std::move(remedy)});
    if (noted_ == Obstacles::kIgnored) continue;
    for (const PartId part : resolver.Obstacles(unmet)) obstacles_.insert(part);
  }
  return candidates;
}

// Tries the combinations with a candidate that may absorb errors, or those without one.
std::optional<RemedySearch::Mended> RemedySearch::ProvingRemedies(Absorbing absorbing) {
  const std::vector<Combinable> items = Items();
  std::optional<Mended> proving;
  const auto proves = [&](const std::vector<int>& chosen) {
    const bool may_absorb = std::ranges::any_of(
        chosen, [&](int c) { return !ResolverOf(items[c].group).absorbs().empty(); });
    if (may_absorb != (absorbing == Absorbing::kYes)) return false;
    ++combinations_;
    Mended mended = With(chosen);
    if (const auto unproved = FirstUnproved(mended)) {
      NoteNeighbours(unproved->after);
      return false;
    }
    proving = std::move(mended);
    return true;
  };
  VisitCombinations(items, task_.options.most_remedies, task_.options.combinations, proves);
  return proving;
}

std::optional<RemedySearch::Mended> RemedySearch::Nearing() {
  std::optional<Mended> nearest;
  std::optional<Shortfall> least = ShortfallAfter({steps_, step_});
  std::vector<Combinable> items = Items();
  std::erase_if(items, [&](const Combinable& item) { return ResolverOf(item.group).disturbs(); });
  const auto compare = [&](const std::vector<int>& chosen) {
    Mended mended = With(chosen);
    const std::optional<Shortfall> shortfall = ShortfallAfter(mended);
    if (!shortfall || !shortfall->IsLessThan(*least)) return false;
    least = shortfall;
    nearest = std::move(mended);
    return false;
  };
  VisitCombinations(items, task_.options.most_remedies, task_.options.combinations, compare);
  return nearest;
}

// Adds to each reason for moving parts the goals that remain unmet without moving parts.
void RemedySearch::NoteWhatFellShort(AugmentedStep& mended) {
  const auto disturbs = [&](const Measure& measure) { return Disturbs(measure); };
  if (std::ranges::none_of(mended.measures, disturbs)) return;
  const std::optional<Mended> nearest = Nearing();
  if (!nearest) return;
  const AugmentedStep& nearer = nearest->steps[nearest->step];
  const SnapshotId after = nearest->steps.SnapshotAfter(nearest->step, task_.possible);
  if (nearer.Unabsorbed(task_.possible.UnprovedAt(after)).empty()) return;
  for (Measure& measure : mended.measures) {
    if (!disturbs(measure) || measure.because != unmet_) continue;
    measure.without_moving = {nearer.measures.back().resolver, {after, nearer.absorbed}};
  }
}

bool RemedySearch::Disturbs(const Measure& measure) const {
  return std::ranges::any_of(task_.options.resolvers, [&](const auto& resolver) {
    return resolver->name() == measure.resolver && resolver->disturbs();
  });
}

std::vector<Combinable> RemedySearch::Items() const {
  std::vector<Combinable> items;
  for (const Candidate& candidate : candidates_) {
    items.push_back({candidate.resolver, candidate.remedy.part.index()});
  }
  return items;
}

// Returns the plan's steps with the chosen remedies inserted.
RemedySearch::Mended RemedySearch::With(const std::vector<int>& chosen) const {
  Mended mended = {.steps = steps_.WithoutAny()};
  AugmentedStep target = steps_[step_];
  int next_id = steps_.NextId().index();
  for (int position = 0; position < steps_.size(); ++position) {
    for (const int c : chosen) {
      for (const Insertion& insertion : candidates_[c].remedy.insertions) {
        if (insertion.before != position) continue;
        const plan::StepId id(next_id++);
        mended.steps.Add({.id = id, .action = insertion.action});
        target.Note(NameOf(candidates_[c]), unmet_).steps.push_back(id);
      }
    }
    if (position == step_) mended.step = mended.steps.size();
    mended.steps.Add(steps_[position]);
  }
  for (const int c : chosen) {
    const Remedy& remedy = candidates_[c].remedy;
    target.absorbed.insert(target.absorbed.end(), remedy.absorbs.begin(), remedy.absorbs.end());
    if (remedy.strategy) target.strategy = remedy.strategy;
    target.Note(NameOf(candidates_[c]), unmet_);
  }
  mended.steps[mended.step] = std::move(target);
  return mended;
}

std::string RemedySearch::NameOf(const Candidate& candidate) const {
  return std::string(ResolverOf(candidate.resolver).name());
}

// Returns the first step that must be proved and is not, or none. Three kinds of steps must be
// proved: the step for which the remedy is, new steps before this step, and those steps after a new
// step that were not accepted as unproved.
std::optional<RemedySearch::UnprovedStep> RemedySearch::FirstUnproved(const Mended& mended) const {
  uncertainty::WorldTree& tree = task_.possible;
  SnapshotId snapshot = tree.Beginning();
  bool is_changed = false;
  const plan::StepId next_id = steps_.NextId();
  for (int i = 0; i <= mended.step; ++i) {
    const AugmentedStep& step = mended.steps[i];
    snapshot = tree.After(snapshot, step.action, step.way());
    is_changed |= step.id.index() >= next_id.index();
    const bool must_be_proved = i == mended.step || (is_changed && !step.given_up);
    if (must_be_proved && !step.IsProved(tree, snapshot)) return {{i, snapshot}};
  }
  return std::nullopt;
}

// Returns none if the mended step is not reached, because an earlier step is not proved.
std::optional<Shortfall> RemedySearch::ShortfallAfter(const Mended& mended) const {
  const auto unproved = FirstUnproved(mended);
  if (!unproved) return Shortfall{};
  if (unproved->step < mended.step) return std::nullopt;
  const std::vector<Unproved>& goals = task_.possible.UnprovedAt(unproved->after);
  return ShortfallOf(mended.steps[mended.step].Unabsorbed(goals));
}

void RemedySearch::NoteNeighbours(SnapshotId after) {
  const std::vector<Unproved>& unproved = task_.possible.UnprovedAt(after);
  if (!std::ranges::all_of(unproved, DependsOnPlace)) return;
  for (const Unproved& goal : unproved) {
    if (!goal.neighbour.IsNone()) obstacles_.insert(goal.neighbour);
  }
}

}  // namespace assay::constraint_posting
