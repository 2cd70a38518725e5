#include "planner/contingent/search/sub_plans.h"

#include <algorithm>

#include "planner/base/check.h"

namespace assay::contingent {

SubPlans::SubPlans(KnowledgeSpace& space)
    : space_(space), regression_(space), by_atom_(space.task().atoms.size()) {
  nodes_.Intern({});
}

std::optional<NodeId> SubPlans::Find(StateId state) {
  if (const auto known = entry_of_state_.find(state); known != entry_of_state_.end()) {
    return entries_[known->second].node;
  }
  // Entries that were tried for this state before and did not serve it are skipped.
  int& looked_at = looked_at_[state];
  const auto found_in = [&](const std::vector<int>& candidates) {
    const auto first = std::lower_bound(candidates.begin(), candidates.end(), looked_at);
    const auto found = std::find_if(first, candidates.end(),
                                    [&](int index) { return Suits(entries_[index], state); });
    if (found != candidates.end()) entry_of_state_[state] = *found;
    return found != candidates.end();
  };
  const KnowledgeState& here = space_.state(state);
  bool is_found = found_in(without_atom_);
  for (std::size_t a = 0; a < by_atom_.size() && !is_found; ++a) {
    if (by_atom_[a].empty()) continue;
    is_found =
        space_.knowledge().layout().IsKnown(here, {AtomId(a), true}) && found_in(by_atom_[a]);
  }
  looked_at = static_cast<int>(entries_.size());
  if (!is_found) return std::nullopt;
  return entries_[entry_of_state_[state]].node;
}

const Requirement& SubPlans::RequirementOf(NodeId child, StateId outcome) {
  if (child == Goal()) {
    const auto [entry, is_new] = goal_requirements_.try_emplace(outcome);
    if (is_new) entry->second = regression_.OfGoal(outcome);
    return entry->second;
  }
  const auto found = entry_of_state_.find(outcome);
  ASSAY_CHECK(found != entry_of_state_.end(), "a sub-plan for a state that it was not found for");
  return entries_[found->second].requirement;
}

NodeId SubPlans::Add(StateId state, const Transition& transition,
                     const std::vector<NodeId>& children) {
  std::vector<const Requirement*> after;
  for (std::size_t i = 0; i < children.size(); ++i) {
    after.push_back(&RequirementOf(children[i], transition.outcomes[i]));
  }
  const NodeId node = nodes_.Intern(NodeOf(transition, children));
  Entry entry{node, state, regression_.OfStep(state, transition, after)};
  const int index = static_cast<int>(entries_.size());
  File(entry, index);
  entries_.push_back(std::move(entry));
  entry_of_state_[state] = index;
  return entries_.back().node;
}

bool SubPlans::Suits(const Entry& entry, StateId state) {
  const KnowledgeState& here = space_.state(state);
  return std::all_of(entry.literals.begin(), entry.literals.end(),
                     [&](const GroundLiteral& l) {
                       return space_.knowledge().layout().IsKnown(here, l);
                     }) &&
         regression_.Suits(entry.requirement, entry.made_in, state);
}

void SubPlans::File(Entry& entry, int index) {
  if (entry.requirement.worlds == kEmptySet) return;
  std::vector<int>* fewest = nullptr;
  WorldSets& worlds = space_.knowledge().worlds();
  for (const Assignment& a : worlds.Essential(entry.requirement.worlds)) {
    const AtomId atom = worlds.AtomOf(a.variable);
    entry.literals.push_back({atom, a.value});
    std::vector<int>& filed = by_atom_[atom.index()];
    if (a.value && (fewest == nullptr || filed.size() < fewest->size())) fewest = &filed;
  }
  (fewest != nullptr ? *fewest : without_atom_).push_back(index);
}

}  // namespace assay::contingent
