#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "planner/contingent/search/node_table.h"
#include "planner/contingent/search/requirement.h"

namespace assay::contingent {

// The sub-plans that a search has completed, each with its requirement. A state from which one of
// them works needs no search of its own. Equal sub-plans are one node.
class SubPlans {
 public:
  explicit SubPlans(KnowledgeSpace& space);

  NodeId Goal() const { return NodeId(0); }

  // Returns the first sub-plan found that works from the state.
  std::optional<NodeId> Find(StateId state);

  // Adds the sub-plan that takes the step and continues with `children`, which work from the
  // outcomes.
  NodeId Add(StateId state, const Transition& transition, const std::vector<NodeId>& children);

  bool IsEmpty() const { return entries_.empty(); }
  const std::vector<PlanNode>& nodes() const { return nodes_.nodes(); }

 private:
  struct Entry {
    NodeId node;
    StateId made_in;
    Requirement requirement;
    // literals that hold in all required worlds, for quick rejection
    std::vector<GroundLiteral> literals = {};
  };

  // Returns the requirement of the child. The child must be a sub-plan that works from the outcome.
  const Requirement& RequirementOf(NodeId child, StateId outcome);
  void File(Entry& entry, int index);
  bool Suits(const Entry& entry, StateId state);

  KnowledgeSpace& space_;
  Regression regression_;
  NodeTable nodes_;
  std::vector<Entry> entries_;
  // Entries by one atom that they require to be known true: the atom with the fewest entries.
  // Entries without such an atom are in without_atom_.
  std::vector<std::vector<int>> by_atom_;
  std::vector<int> without_atom_;
  // For each state for which a sub-plan was found or added: the index of the sub-plan's entry.
  std::unordered_map<StateId, int> entry_of_state_;
  // indexed by state: the number of entries that have been tried
  std::unordered_map<StateId, int> looked_at_;
  std::unordered_map<StateId, Requirement> goal_requirements_;
};

}  // namespace assay::contingent
