#pragma once

#include <deque>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "planner/base/budget.h"
#include "planner/contingent/knowledge/knowledge_base.h"
#include "planner/contingent/plan_tree/plan_tree.h"

namespace assay::contingent {

using StateId = Id<struct KnowledgeStateTag>;

// One step of a plan: an action, or a branch.
struct Step {
  PlanNode::Kind kind = PlanNode::Kind::kAct;
  ActionId action = {};
  FormulaId formula = {};
  FunctionId function = {};

  bool operator==(const Step&) const = default;
};

// A step with the states that it may lead to. A plan must continue from each of them. An action has
// one outcome, a formula has two, with true before false, and a function has one for each possible
// value.
struct Transition {
  Step step;
  std::vector<AtomId> values = {};  // the values of a function, one for each outcome
  std::vector<StateId> outcomes = {};
};

PlanNode NodeOf(const Transition& transition, const std::vector<NodeId>& children);

// The knowledge states that a search has met, each stored once, and the steps between them.
class KnowledgeSpace {
 public:
  // Each call of StepsFrom takes one unit of the budget.
  KnowledgeSpace(const GroundTask& task, Budget& budget);

  KnowledgeBase& knowledge() { return knowledge_; }
  const GroundTask& task() const { return knowledge_.task(); }
  Budget& budget() { return budget_; }

  StateId initial();
  const KnowledgeState& state(StateId id) const { return states_[id.index()]; }
  std::size_t size() const { return states_.size(); }
  bool IsGoal(StateId id) { return Surely(task().goal, state(id)); }

  // Says in words why this search proves nothing about states that it has not met. Empty if
  // StepsFrom returned every step that any plan can take.
  const std::string& doubt();

  // Returns the steps from a state, in the order of the task. If Kw has a formula on which the plan
  // can branch, this branch is the only step. The truth of the formula is known from then on at run
  // time, so an immediate branch loses nothing, unless something asks that a fact is not known. A
  // branch on a function's value is optional, because a run-time variable can use the value without
  // knowing it.
  const std::vector<Step>& StepsFrom(StateId id);
  // Returns the transition of the step at this index in StepsFrom, which must have been called for
  // the state. Returns null if the step cannot be taken or changes nothing.
  const Transition* Take(StateId id, std::size_t step);

 private:
  // The steps from a state. Each transition is computed once, when it is asked for.
  struct Expansion {
    std::vector<Step> steps;
    std::vector<std::optional<Transition>> transitions;
    std::vector<bool> is_tried;
  };

  StateId Intern(KnowledgeState state);
  // Returns true if the query surely holds. Records a doubt if it may hold but does not surely
  // hold.
  bool Surely(const GroundQuery& query, const KnowledgeState& state);
  // Adds a state to the outcomes. Returns false if there is no state; then the step cannot be
  // taken.
  bool AddOutcome(std::optional<KnowledgeState> state, Transition& transition);
  Expansion& ExpansionOf(StateId id);
  std::vector<Step> FindSteps(StateId id);
  // Records a doubt if a query asks for a sensed value on which no step of the list branches.
  void DoubtValuesBeyond(const std::vector<Step>& branches, const KnowledgeState& from);
  std::optional<Transition> Try(StateId id, const Step& step);

  KnowledgeBase knowledge_;
  Budget& budget_;
  std::deque<KnowledgeState> states_;
  InternTable ids_;
  std::unordered_map<StateId, Expansion> expansions_;
  const bool asks_for_ignorance_;
  const std::set<FunctionId> functions_asked_for_;
  std::string doubt_;  // the latest doubt, empty if there is none
};

}  // namespace assay::contingent
