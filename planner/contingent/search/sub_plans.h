#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "planner/contingent/knowledge/requirement.h"
#include "planner/contingent/search/node_table.h"

namespace assay::contingent {

// The sub-plans that a search has completed, each with what it requires, so that a state from which
// one of them works needs no search of its own. Equal sub-plans are one node.
class SubPlans {
 public:
  explicit SubPlans(KnowledgeSpace& space);

  NodeId Goal() const { return NodeId(0); }

  // A sub-plan that works from the state: the first one that was found.
  std::optional<NodeId> Find(StateId state);

  // The sub-plan that takes the step and goes on with the children, which work from the outcomes.
  NodeId Add(StateId state, const Transition& transition, const std::vector<NodeId>& children);

  bool IsEmpty() const { return entries_.empty(); }
  const std::vector<PlanNode>& nodes() const { return nodes_.nodes(); }

 private:
  struct Entry {
    NodeId node;
    StateId made_in;
    Requirement requirement;
    std::vector<GroundLiteral> literals = {};  // that all required worlds have, to reject quickly
  };

  // What is known of an outcome from which the child works.
  const Requirement& RequirementOf(NodeId child, StateId outcome);
  void File(Entry& entry, int index);
  bool Suits(const Entry& entry, StateId state);

  KnowledgeSpace& space_;
  Regression regression_;
  NodeTable nodes_;
  std::vector<Entry> entries_;
  // Entries by an atom that they require to be known true (the one that the fewest others are filed
  // under); those without such an atom.
  std::vector<std::vector<int>> by_atom_;
  std::vector<int> without_atom_;
  // Which entry serves a state, where that has been found out.
  std::unordered_map<StateId, int> entry_of_state_;
  std::unordered_map<StateId, int> looked_at_;  // so many entries, by state
  std::unordered_map<StateId, Requirement> goal_requirements_;
};

}  // namespace assay::contingent
