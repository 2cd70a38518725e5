#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/constraint_posting/geometric_relations.h"
#include "planner/constraint_posting/ordering_graph.h"
#include "planner/domain/actions/action_template.h"
#include "planner/network/constraint_network/conflict.h"
#include "planner/network/constraint_network/network.h"

namespace assay::constraint_posting {

using domain::VariableId;

// An operational goal: the condition must hold just before the consumer. Its establisher must come
// after each of the steps in `after`, because they undo the condition.
struct OperationalGoal {
  StepId consumer;
  int precondition;
  std::vector<StepId> after = {};
};

// A causal link: the producer establishes the consumer's precondition number `precondition`. Any
// producer of the link must come after the steps in `after`.
struct CausalLink {
  StepId producer;
  StepId consumer;
  int precondition;
  std::vector<StepId> after = {};
};

// A geometric goal, as number `goal` of the consumer's geometric goals.
struct GeometricGoalRef {
  StepId consumer;
  int goal;
};

// A step that may undo the condition of a causal link.
struct Threat {
  CausalLink link;
  StepId violator;
};

// The goal that a part is not where it was at the start, as precondition number `precondition` of
// the consumer. `why` says what cannot be proved about the consumer as long as the part is there.
// `why` is empty if the consumer could not even be executed.
struct RequiredMove {
  StepId consumer;
  domain::PartId part;
  int precondition;
  std::string why;
};

// The open goals by type. The top of each stack is its back. The stacks are served in this order.
// Geometric goals come when no operational goal is left on which they could depend (Spar).
// Operational goals without a plan variable, gripper(open), come last: their establishment only
// orders steps, and ordering steps is useless before the geometry is known to allow them.
struct GoalStacks {
  std::vector<Threat> threats;
  std::vector<OperationalGoal> operational;
  std::vector<GeometricGoalRef> geometric;
  std::vector<OperationalGoal> ordering;
};

// A family of plans: unordered steps, with separate constraints on when and how they are executed
// (Spar, "Representation of Plans"). It is a value: a search copies it at each choice and drops the
// copy to backtrack. An operation that returns false may leave the plan half changed, so the plan
// must then be dropped.
class PartialPlan {
 public:
  // Makes the null plan. Its first step is the initial world, and its last step has the goals as
  // preconditions.
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
  // Returns the step that establishes a precondition, or None as long as it is open.
  StepId ProducerOf(StepId consumer, int precondition) const;
  const domain::GeometricConstraint& ConstraintOf(const GeometricGoalRef& goal) const;
  // Returns the variable to which a precondition's variable is bound, or the variable itself if it
  // is a step's own.
  VariableId Resolve(VariableId variable) const;
  // Returns the node of a variable that is bound or a step's own.
  network::NodeId NodeOf(VariableId variable) const;
  // Returns the labels that the variable can still have.
  network::LabelSet Labels(VariableId variable) const;

  // Each of these functions removes and returns the top of one stack. PopThreat skips threats that
  // ordering constraints have resolved.
  std::optional<Threat> PopThreat();
  std::optional<OperationalGoal> PopOperational();
  std::optional<GeometricGoalRef> PopGeometric();
  std::optional<OperationalGoal> PopOrdering();

  // ---- Operational refinements (Spar, "Satisfying Operational Goals") ----------------------
  //
  // Returns new instances of all actions that could establish the goal.
  std::vector<domain::ActionTemplate> Establishers(const OperationalGoal& goal);
  // Adds an action, and puts its preconditions on the goal stacks.
  StepId AddStep(domain::ActionTemplate action);
  // CanEstablish returns true if the step adds the goal's condition. Establish makes the step the
  // producer.
  bool CanEstablish(StepId producer, const OperationalGoal& goal) const;
  bool Establish(StepId producer, const OperationalGoal& goal);

  // true if it is a threat under the present constraints
  bool IsThreat(const Threat& threat) const;
  bool Promote(const Threat& threat);   // posts prior_to(consumer, violator)
  bool Separate(const Threat& threat);  // forbids that the two codesignate
  // Puts the goal of the threatened link back on its stack. The goal must then be established after
  // the violator, and after the violators for which it was reopened before. A goal is therefore
  // reopened at most once for each step of the plan.
  void Reopen(const Threat& threat);

  // ---- Geometric refinements (Spar, "Satisfying Geometric Goals") --------------------------
  //
  // Posts the constraint to the network. Returns false if no labeling would be left.
  bool Post(const GeometricGoalRef& goal);
  // Returns, in words, a minimal set of constraints that no labeling satisfies together. The last
  // one is the constraint of `goal`, which was refused.
  std::vector<std::string> WhyRefused(const GeometricGoalRef& goal) const;
  // Adds an operational and geometric goal to a step: the part must not be where it was at the
  // start.
  void RequireMoved(StepId consumer, domain::PartId part, const std::string& why);
  const std::vector<RequiredMove>& required_moves() const { return required_moves_; }
  // Records that the part is not to be moved for the step. Another branch of the search covers the
  // plans that move it.
  void Keep(StepId consumer, domain::PartId part) { kept_.emplace_back(consumer, part); }
  bool IsKept(StepId consumer, domain::PartId part) const;

  // Returns a text for a person. Variables have the names of the variables to which they are bound.
  std::string Text(StepId step) const;
  std::string Text(const domain::Condition& condition) const;
  std::string Text(const domain::GeometricConstraint& constraint) const;

 private:
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
  std::vector<std::pair<VariableId, VariableId>> separations_;  // pairs that must not codesignate
  // indexed by variable; None if it is not bound
  std::vector<VariableId> binding_;
  std::vector<network::NodeId> nodes_;  // indexed by variable; None if it has no labels of its own
};

}  // namespace assay::constraint_posting
