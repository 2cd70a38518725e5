#pragma once

#include <deque>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "planner/base/budget.h"
#include "planner/contingent/knowledge/knowledge_base.h"
#include "planner/contingent/tree/plan_tree.h"

namespace assay::contingent {

using StateId = Id<struct KnowledgeStateTag>;

// What can come next in a plan: an action, or a branch.
struct Step {
  PlanNode::Kind kind = PlanNode::Kind::kAct;
  ActionId action = {};
  FormulaId formula = {};
  FunctionId function = {};

  bool operator==(const Step&) const = default;
};

// A step with the states that it may lead to, all of which a plan must be ready for: one of an
// action, true before false of a formula, one for each possible value of a function.
struct Transition {
  Step step;
  std::vector<AtomId> values = {};  // of a function
  std::vector<StateId> outcomes = {};
};

PlanNode NodeOf(const Transition& transition, const std::vector<NodeId>& children);

// The knowledge states that are met, each once, and the steps between them.
class KnowledgeSpace {
 public:
  // Each time that the steps from a state are asked for takes one unit of the budget.
  KnowledgeSpace(const GroundTask& task, Budget& budget);

  KnowledgeBase& knowledge() { return knowledge_; }
  const GroundTask& task() const { return knowledge_.task(); }
  Budget& budget() { return budget_; }

  StateId initial();
  const KnowledgeState& state(StateId id) const { return states_[id.index()]; }
  std::size_t size() const { return states_.size(); }
  bool IsGoal(StateId id) { return Surely(task().goal, state(id)); }

  // Why all that was met proves nothing of what was not met, in words; empty: every step that any
  // plan can take was among those that were told.
  const std::string& doubt();

  // The steps from a state, in the order of the task. Where a formula of Kw branches, that is the
  // only step: at run time its truth is known from then on, so that nothing is lost by telling its
  // cases apart at once, unless something asks for what is not known. A branch on a function's
  // value is a choice: the value may as well be used without being known (a run-time variable).
  const std::vector<Step>& StepsFrom(StateId id);
  // The step of this place in StepsFrom, which has been asked for. Null if it cannot be taken or
  // changes nothing.
  const Transition* Take(StateId id, std::size_t step);

 private:
  // What is known of the steps from a state: all is found out once, and only if it is asked for.
  struct Expansion {
    std::vector<Step> steps;
    std::vector<std::optional<Transition>> transitions;
    std::vector<bool> is_tried;
  };

  StateId Intern(KnowledgeState state);
  // Where it may hold, and it cannot be told whether it does, that is a doubt.
  bool Surely(const GroundQuery& query, const KnowledgeState& state);
  // False if there is none: then the step cannot be taken.
  bool AddOutcome(std::optional<KnowledgeState> state, Transition& transition);
  Expansion& ExpansionOf(StateId id);
  std::vector<Step> FindSteps(StateId id);
  std::optional<Transition> Try(StateId id, const Step& step);

  KnowledgeBase knowledge_;
  Budget& budget_;
  std::deque<KnowledgeState> states_;
  algebra::InternTable ids_;
  std::unordered_map<StateId, Expansion> expansions_;
  const bool asks_for_ignorance_;
  std::string doubt_;  // the first
};

}  // namespace assay::contingent
