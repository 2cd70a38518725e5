#pragma once

#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/knowledge/knowledge_state.h"

namespace assay::contingent {

// How far a goal is, and which actions lead there.
struct RelaxedPlan {
  static constexpr int kUnreached = 1 << 20;
  int actions = kUnreached;
  std::vector<ActionId> helpful;  // those of the plan that begin it, sorted
};

// Planning where knowledge is never lost: from what is known, actions make literals known, sensing
// makes known whichever of a literal and its negation is wanted, and relations of the initial state
// settle their last member. A relaxed plan is found as in FF (Hoffmann and Nebel 2001), by costs
// that are summed over preconditions. Neither a lower nor an upper bound. That something is not
// known counts as always true.
class RelaxedKnowledgeGraph {
 public:
  explicit RelaxedKnowledgeGraph(const GroundTask& task);

  RelaxedPlan PlanFrom(const KnowledgeState& state);

 private:
  using Proposition = int;
  struct Operator {
    std::vector<Proposition> preconditions;
    std::vector<Proposition> additions;
    ActionId action;  // none for what follows by itself
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
  // What the query needs; alternatives become a proposition of their own.
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

  // Of one computation.
  std::vector<int> cost_;     // of propositions
  std::vector<int> best_;     // the operator that adds it at this cost, -1: it is there
  std::vector<int> missing_;  // preconditions of operators
  std::vector<int> sum_;      // their cost
  std::vector<std::vector<Proposition>> queue_;  // by cost
};

}  // namespace assay::contingent
