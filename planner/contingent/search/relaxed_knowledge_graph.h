#pragma once

#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/knowledge/knowledge_state.h"

namespace assay::contingent {

// An estimate of the number of actions to the goal, and the actions with which a plan should begin.
struct RelaxedPlan {
  static constexpr int kUnreached = 1 << 20;
  int actions = kUnreached;
  std::vector<ActionId> helpful;  // the first actions of the relaxed plan, sorted
};

// A relaxed problem in which knowledge is never lost. Actions make literals known. Sensing makes a
// literal or its negation known, whichever is wanted. If all members of a relation of the initial
// state are known except one, the relation makes this member known. The relaxed plan is found as in
// FF (Hoffmann and Nebel 2001), with costs that are summed over preconditions. Its length is
// neither a lower nor an upper bound. A condition that something is not known counts as true.
class RelaxedKnowledgeGraph {
 public:
  explicit RelaxedKnowledgeGraph(const GroundTask& task);

  RelaxedPlan PlanFrom(const KnowledgeState& state);

 private:
  using Proposition = int;
  struct Operator {
    std::vector<Proposition> preconditions;
    std::vector<Proposition> additions;
    ActionId action;  // none for a consequence that needs no action
  };

  Proposition Known(GroundLiteral literal) const {
    return 2 * literal.atom.index() + (literal.is_positive ? 0 : 1);
  }
  Proposition Sensed(FormulaId formula) const { return first_formula_ + formula.index(); }
  Proposition Sensed(FunctionId function) const { return first_function_ + function.index(); }

  void AddRelation(const InitialRelation& relation);
  void AddSensing(const GroundTask& task);
  void AddEffects(const std::vector<GroundEffect>& effects,
                  const std::vector<Proposition>& preconditions, ActionId action);
  std::vector<Proposition> AdditionsOf(const GroundEffect& effect) const;
  // Adds the propositions that the query needs. A disjunction becomes a proposition of its own.
  void AddNeeds(const GroundQuery& query, std::vector<Proposition>& needs);
  void AddOperator(std::vector<Proposition> preconditions, std::vector<Proposition> additions,
                   ActionId action);
  void ComputeCosts(const KnowledgeState& state);
  void Improve(Proposition proposition, int cost, int by);
  void Fire(int op);

  const GroundTask& task_;
  StateLayout layout_;
  int first_formula_;
  int first_function_;
  int propositions_;
  std::vector<Operator> operators_;
  std::vector<Proposition> goal_;
  std::vector<std::vector<int>> needed_by_;  // operators, by proposition
  std::vector<int> always_;                  // operators without preconditions

  // The members below belong to one call of PlanFrom.
  std::vector<int> cost_;  // the costs of propositions
  // indexed by proposition: the operator that adds the proposition most cheaply, or -1 if the
  // proposition holds in the state
  std::vector<int> best_;
  std::vector<int> missing_;  // by operator: the number of preconditions that are not reached
  std::vector<int> sum_;      // by operator: the summed cost of its reached preconditions
  std::vector<std::vector<Proposition>> queue_;  // propositions by cost
};

}  // namespace assay::contingent
