#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/domain/actions/action_template.h"
#include "planner/network/network/conflict.h"
#include "planner/network/network/network.h"
#include "planner/posting/geometric_relations.h"
#include "planner/posting/ordering_graph.h"

namespace assay::posting {

using domain::VariableId;

// An operational goal: the condition must hold just before the consumer. Its establisher must come
// after each of the steps in `after`, which undo it.
struct OperationalGoal {
  StepId consumer;
  int precondition;
  std::vector<StepId> after = {};
};

// producer makes true what consumer needs as its precondition number `precondition`. Any other
// producer must come after `after`, as this one does.
struct CausalLink {
  StepId producer;
  StepId consumer;
  int precondition;
  std::vector<StepId> after = {};
};

// A geometric goal: number `goal` of the consumer's geometric goals.
struct GeometricGoalRef {
  StepId consumer;
  int goal;
};

// A step that may undo what a causal link keeps.
struct Threat {
  CausalLink link;
  StepId violator;
};

// The goal that a part is somewhere else than where it was at the start: precondition number
// `precondition` of the consumer. `why`: what cannot be proved of the consumer otherwise; empty if
// it could not even be executed.
struct RequiredMove {
  StepId consumer;
  domain::PartId part;
  int precondition;
  std::string why;
};

// The goals that are still open, by type; each stack's top is its back. They are served in this
// order: geometric goals when no operational one is left that they could depend on (Spar), and
// last the operational goals without a plan variable, gripper(open): how these are established
// only orders steps, and there is no use in ordering steps that no geometry allows.
struct GoalStacks {
  std::vector<Threat> threats;
  std::vector<OperationalGoal> operational;
  std::vector<GeometricGoalRef> geometric;
  std::vector<OperationalGoal> ordering;
};

// A family of plans: steps without an order of their own, and separate constraints on when and how
// they are executed (Spar, "Representation of Plans"). A value: a search copies it at each choice
// and drops the copy to backtrack. Every operation that answers false may leave the plan half
// changed, to be dropped.
class PartialPlan {
 public:
  // The null plan: the initial world as its first step, the goals as preconditions of its last.
  PartialPlan(const domain::Problem& problem, const GeometricRelations& relations);

  static constexpr StepId kStart{0};
  static constexpr StepId kFinish{1};

  const domain::Problem& problem() const { return *problem_; }
  const GeometricRelations& relations() const { return *relations_; }
  const std::vector<domain::ActionTemplate>& steps() const { return steps_; }
  const domain::ActionTemplate& step(StepId id) const { return steps_[id.index()]; }
  int action_count() const { return static_cast<int>(steps_.size()) - 2; }
  const domain::PlanVariables& variables() const { return variables_; }
  const OrderingGraph& ordering() const { return ordering_; }
  const network::Network& network() const { return network_; }
  const GoalStacks& goals() const { return goals_; }
  const std::vector<CausalLink>& links() const { return links_; }
  const std::vector<GeometricGoalRef>& satisfied_geometric() const { return satisfied_geometric_; }

  const domain::Condition& ConditionOf(StepId consumer, int precondition) const;
  // The step that establishes a precondition; None as long as it is open.
  StepId ProducerOf(StepId consumer, int precondition) const;
  const domain::GeometricConstraint& ConstraintOf(const GeometricGoalRef& goal) const;
  // The variable that a precondition's variable is bound to; itself if it is a step's own.
  VariableId Resolve(VariableId variable) const;
  // The node of a variable that is bound or a step's own.
  network::NodeId NodeOf(VariableId variable) const;
  // The labels that it can still have.
  network::LabelSet Labels(VariableId variable) const;

  // The next of each stack. Threats that orderings have meanwhile resolved are passed over.
  std::optional<Threat> PopThreat();
  std::optional<OperationalGoal> PopOperational();
  std::optional<GeometricGoalRef> PopGeometric();
  std::optional<OperationalGoal> PopOrdering();

  // ---- Operational refinements (Spar, "Satisfying Operational Goals") ----------------------
  // Fresh instances of all actions that could establish the goal.
  std::vector<domain::ActionTemplate> Establishers(const OperationalGoal& goal);
  // A new action, with its preconditions on the goal stacks.
  StepId AddStep(domain::ActionTemplate action);
  // The goal is established by a step that adds its condition.
  bool CanEstablish(StepId producer, const OperationalGoal& goal) const;
  bool Establish(StepId producer, const OperationalGoal& goal);

  bool IsThreat(const Threat& threat) const;  // under the constraints so far
  bool Promote(const Threat& threat);         // prior_to(consumer, violator)
  bool Separate(const Threat& threat);        // the two must not codesignate
  // The goal goes back on its stack, to be established after the violator, and after those that
  // threatened it before: so it goes back once for each step of the plan at most.
  void Reopen(const Threat& threat);

  // ---- Geometric refinements (Spar, "Satisfying Geometric Goals") --------------------------
  // Posts the constraint to the network. False if no labeling would be left.
  bool Post(const GeometricGoalRef& goal);
  // Of a goal whose constraint was refused: a minimal set of constraints, with that of the goal the
  // last, that no labeling satisfies together, in words.
  std::vector<std::string> WhyRefused(const GeometricGoalRef& goal) const;
  // One more operational and geometric goal of a step: that the part is somewhere else than where
  // it was at the start.
  void RequireMoved(StepId consumer, domain::PartId part, const std::string& why);
  const std::vector<RequiredMove>& required_moves() const { return required_moves_; }
  // The goal is not to be posted: plans in which the part is moved for the step are looked for
  // elsewhere.
  void Keep(StepId consumer, domain::PartId part) { kept_.emplace_back(consumer, part); }
  bool IsKept(StepId consumer, domain::PartId part) const;

  // In words, with variables by the names of those that they are bound to.
  std::string Text(StepId step) const;
  std::string Text(const domain::Condition& condition) const;
  std::string Text(const domain::GeometricConstraint& constraint) const;

 private:
  void AddInitialWorld();
  void AddGoals();
  StepId Append(domain::ActionTemplate action);
  void OpenPreconditions(StepId step);
  void Open(OperationalGoal goal);
  void AddNode(VariableId variable, const std::vector<int>& labels);
  int LabelCount(VariableId variable) const;
  bool HasNode(VariableId variable) const;
  network::Constraint NetworkConstraint(const domain::GeometricConstraint& constraint) const;
  VariableId ResolveIfAny(VariableId variable) const;
  bool MayCodesignate(VariableId a, VariableId b) const;
  void FindThreatsOf(StepId step);
  void FindThreatsTo(const CausalLink& link);
  void Unlink(const CausalLink& link);
  network::Network WithoutGeometricGoals() const;
  void RebuildNetwork();

  const domain::Problem* problem_;
  const GeometricRelations* relations_;
  std::vector<domain::ActionTemplate> steps_;
  domain::PlanVariables variables_;
  OrderingGraph ordering_;
  network::Network network_;
  GoalStacks goals_;
  std::vector<CausalLink> links_;
  std::vector<GeometricGoalRef> satisfied_geometric_;
  std::vector<RequiredMove> required_moves_;
  std::vector<std::pair<StepId, domain::PartId>> kept_;
  std::vector<std::pair<VariableId, VariableId>> separations_;  // must not codesignate
  std::vector<VariableId> binding_;                             // by variable; None: not bound
  std::vector<network::NodeId> nodes_;  // by variable; None: it has no labels of its own
};

}  // namespace assay::posting
