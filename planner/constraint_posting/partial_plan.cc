#include "planner/constraint_posting/partial_plan.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>
#include <variant>

#include "planner/base/check.h"
#include "planner/constraint_posting/null_plan.h"

namespace assay::constraint_posting {

using domain::ActionTemplate;
using domain::Condition;
using domain::ConstraintKind;
using domain::GeometricConstraint;
using domain::PartId;
using domain::Problem;
using domain::VariableKind;
using network::LabelSet;
using network::NodeId;

namespace {

template <class Item>
std::optional<Item> Pop(std::vector<Item>& stack) {
  if (stack.empty()) return std::nullopt;
  Item top = std::move(stack.back());
  stack.pop_back();
  return top;
}

LabelSet SetOf(int size, const std::vector<int>& labels) {
  LabelSet set = LabelSet::None(size);
  for (int label : labels) set.insert(label);
  return set;
}

bool Same(const CausalLink& a, const CausalLink& b) {
  return a.consumer == b.consumer && a.precondition == b.precondition && a.producer == b.producer;
}

std::shared_ptr<const network::Relation> DifferentLabels(int count) {
  return network::Relation::Where(count, count, [](int a, int b) { return a != b; });
}

std::vector<int> AllStablePoses(const domain::Part& part) {
  std::vector<int> labels(domain::InitialLabel(part));
  std::iota(labels.begin(), labels.end(), 0);
  return labels;
}

}  // namespace

PartialPlan::PartialPlan(const Problem& problem, const GeometricRelations& relations)
    : problem_(&problem), relations_(&relations) {
  Append(InitialWorld(problem, variables_));
  const StepId finish = Append(Goals(problem, variables_));
  ordering_.Post(kStart, finish);
  OpenPreconditions(finish);
}

StepId PartialPlan::Append(ActionTemplate action) {
  const StepId id = ordering_.AddStep();
  for (const domain::InitialConstraint& initial : action.initial) {
    AddNode(initial.variable, initial.labels);
  }
  steps_.push_back(std::move(action));
  binding_.resize(variables_.size(), VariableId::None());
  nodes_.resize(variables_.size(), NodeId::None());
  return id;
}

void PartialPlan::AddNode(VariableId variable, const std::vector<int>& labels) {
  nodes_.resize(variables_.size(), NodeId::None());
  nodes_[variable.index()] = network_.AddNode(SetOf(LabelCount(variable), labels));
}

int PartialPlan::LabelCount(VariableId variable) const {
  const domain::Part& part = problem_->part(variables_[variable].part);
  return variables_[variable].kind == VariableKind::kGrasp ? domain::GraspLabelCount(part)
                                                           : domain::PositionLabelCount(part);
}

void PartialPlan::OpenPreconditions(StepId step) {
  // Goals are pushed in reverse order, so that the first precondition is served first.
  const ActionTemplate& action = steps_[step.index()];
  for (int i = static_cast<int>(action.preconditions.size()) - 1; i >= 0; --i) {
    Open({.consumer = step, .precondition = i});
  }
  for (int i = static_cast<int>(action.geometric.size()) - 1; i >= 0; --i) {
    goals_.geometric.push_back({.consumer = step, .goal = i});
  }
}

void PartialPlan::Open(OperationalGoal goal) {
  const bool orders_only =
      ConditionOf(goal.consumer, goal.precondition).variable.IsNone() && goal.consumer != kFinish;
  (orders_only ? goals_.ordering : goals_.operational).push_back(std::move(goal));
}

const Condition& PartialPlan::ConditionOf(StepId consumer, int precondition) const {
  return steps_[consumer.index()].preconditions[precondition];
}

StepId PartialPlan::ProducerOf(StepId consumer, int precondition) const {
  const auto link = std::ranges::find_if(links_, [&](const CausalLink& l) {
    return l.consumer == consumer && l.precondition == precondition;
  });
  return link == links_.end() ? StepId::None() : link->producer;
}

VariableId PartialPlan::Resolve(VariableId variable) const {
  const VariableId bound = binding_[variable.index()];
  return bound.IsNone() ? variable : bound;
}

bool PartialPlan::HasNode(VariableId variable) const {
  return !nodes_[Resolve(variable).index()].IsNone();
}

NodeId PartialPlan::NodeOf(VariableId variable) const {
  const NodeId node = nodes_[Resolve(variable).index()];
  ASSAY_CHECK(!node.IsNone(), "{} is not bound", variables_[variable].name);
  return node;
}

LabelSet PartialPlan::Labels(VariableId variable) const {
  return network_.labels(NodeOf(variable));
}

std::optional<Threat> PartialPlan::PopThreat() {
  std::optional<Threat> threat = Pop(goals_.threats);
  while (threat && !IsThreat(*threat)) threat = Pop(goals_.threats);
  return threat;
}

std::optional<OperationalGoal> PartialPlan::PopOperational() { return Pop(goals_.operational); }
std::optional<GeometricGoalRef> PartialPlan::PopGeometric() { return Pop(goals_.geometric); }
std::optional<OperationalGoal> PartialPlan::PopOrdering() { return Pop(goals_.ordering); }

std::vector<ActionTemplate> PartialPlan::Establishers(const OperationalGoal& goal) {
  std::vector<ActionTemplate> actions;
  for (const domain::ActionKind* kind : problem_->actions) {
    if (kind->achieve == nullptr) continue;
    std::ranges::move(
        kind->achieve(*problem_, ConditionOf(goal.consumer, goal.precondition), variables_),
        std::back_inserter(actions));
  }
  // An action whose variable has no label, as the grasp of a part that has none, is never possible.
  std::erase_if(actions, [](const ActionTemplate& action) {
    return std::ranges::any_of(action.initial, &std::vector<int>::empty,
                               &domain::InitialConstraint::labels);
  });
  return actions;
}

StepId PartialPlan::AddStep(ActionTemplate action) {
  const StepId step = Append(std::move(action));
  ordering_.Post(kStart, step);
  ordering_.Post(step, kFinish);
  OpenPreconditions(step);
  FindThreatsOf(step);
  return step;
}

bool PartialPlan::CanEstablish(StepId producer, const OperationalGoal& goal) const {
  if (producer == goal.consumer || ordering_.Before(goal.consumer, producer)) return false;
  const Condition& condition = ConditionOf(goal.consumer, goal.precondition);
  return std::ranges::any_of(step(producer).adds,
                             [&](const Condition& add) { return Unify(add, condition); });
}

bool PartialPlan::Establish(StepId producer, const OperationalGoal& goal) {
  if (!ordering_.Post(producer, goal.consumer)) return false;
  for (StepId violator : goal.after) {
    if (!ordering_.Post(violator, producer)) return false;
  }
  const Condition& condition = ConditionOf(goal.consumer, goal.precondition);
  const auto add = std::ranges::find_if(step(producer).adds,
                                        [&](const Condition& a) { return Unify(a, condition); });
  if (!condition.variable.IsNone()) binding_[condition.variable.index()] = add->variable;
  links_.push_back({.producer = producer,
                    .consumer = goal.consumer,
                    .precondition = goal.precondition,
                    .after = goal.after});
  FindThreatsTo(links_.back());
  FindThreatsOf(goal.consumer);  // the binding restricts which conditions this step deletes
  return true;
}

bool PartialPlan::MayCodesignate(VariableId a, VariableId b) const {
  if (a.IsNone() || b.IsNone() || !HasNode(a) || !HasNode(b)) return true;
  if (Resolve(a) == Resolve(b)) return true;
  LabelSet common = Labels(a);
  common.intersect(Labels(b));
  return !common.empty();
}

bool PartialPlan::IsThreat(const Threat& threat) const {
  const auto& [link, violator] = threat;
  const bool linked = std::ranges::any_of(
      links_, [&](const CausalLink& other) { return Same(other, threat.link); });
  if (!linked || violator == link.producer || violator == link.consumer) return false;
  if (ordering_.Before(violator, link.producer) || ordering_.Before(link.consumer, violator)) {
    return false;
  }
  const Condition& kept = ConditionOf(link.consumer, link.precondition);
  return std::ranges::any_of(step(violator).deletes, [&](const Condition& deleted) {
    return Unify(deleted, kept) && MayCodesignate(deleted.variable, kept.variable);
  });
}

void PartialPlan::FindThreatsOf(StepId step) {
  for (const CausalLink& link : links_) {
    const Threat threat{.link = link, .violator = step};
    if (IsThreat(threat)) goals_.threats.push_back(threat);
  }
}

void PartialPlan::FindThreatsTo(const CausalLink& link) {
  for (std::size_t s = 0; s < steps_.size(); ++s) {
    const Threat threat{.link = link, .violator = StepId(s)};
    if (IsThreat(threat)) goals_.threats.push_back(threat);
  }
}

bool PartialPlan::Promote(const Threat& threat) {
  return ordering_.Post(threat.link.consumer, threat.violator);
}

bool PartialPlan::Separate(const Threat& threat) {
  const Condition& kept = ConditionOf(threat.link.consumer, threat.link.precondition);
  for (const Condition& deleted : step(threat.violator).deletes) {
    if (!Unify(deleted, kept)) continue;
    if (deleted.variable.IsNone() || !HasNode(deleted.variable)) return false;
    const VariableId a = Resolve(deleted.variable);
    const VariableId b = Resolve(kept.variable);
    if (a == b) return false;
    const auto differ =
        network::Relation::Where(LabelCount(a), LabelCount(b), [](int x, int y) { return x != y; });
    if (network_.Post(NodeOf(a), NodeOf(b), differ) != Outcome::kFound) return false;
    separations_.emplace_back(a, b);
  }
  return true;
}

void PartialPlan::Reopen(const Threat& threat) {
  std::vector<StepId> after = threat.link.after;
  after.push_back(threat.violator);
  Unlink(threat.link);
  Open({.consumer = threat.link.consumer,
        .precondition = threat.link.precondition,
        .after = std::move(after)});
}

// The link bound a variable, and some geometric goals constrained it. These goals are open again,
// and their constraints are removed from the network.
void PartialPlan::Unlink(const CausalLink& link) {
  std::erase_if(links_, [&](const CausalLink& other) { return Same(other, link); });
  const VariableId variable = ConditionOf(link.consumer, link.precondition).variable;
  if (variable.IsNone()) return;
  binding_[variable.index()] = VariableId::None();
  const auto qualified = [&](const GeometricGoalRef& ref) {
    if (ref.consumer != link.consumer) return false;
    const std::vector<int>& by = step(ref.consumer).geometric[ref.goal].qualifies;
    return std::ranges::count(by, link.precondition) > 0;
  };
  const auto first = std::ranges::stable_partition(
      satisfied_geometric_, [&](const GeometricGoalRef& ref) { return !qualified(ref); });
  if (first.empty()) return;
  goals_.geometric.insert(goals_.geometric.end(), first.begin(), first.end());
  satisfied_geometric_.erase(first.begin(), first.end());
  RebuildNetwork();
  // Label sets have grown, so conditions may codesignate that could not codesignate before.
  for (std::size_t s = 0; s < steps_.size(); ++s) FindThreatsOf(StepId(s));
}

// Returns a network with the initial labels of the variables and with the separations.
network::Network PartialPlan::WithoutGeometricGoals() const {
  network::Network network;
  for (const ActionTemplate& action : steps_) {
    for (const auto& initial : action.initial) {
      network.AddNode(SetOf(LabelCount(initial.variable), initial.labels));
    }
  }
  for (const auto& [a, b] : separations_) {
    network.AddArc(NodeOf(a), NodeOf(b), DifferentLabels(LabelCount(a)));
  }
  return network;
}

void PartialPlan::RebuildNetwork() {
  network_ = WithoutGeometricGoals();
  for (const GeometricGoalRef& ref : satisfied_geometric_) {
    Add(network_, NetworkConstraint(ConstraintOf(ref)));
  }
  const Outcome outcome = network_.Decide();
  ASSAY_CHECK(outcome == Outcome::kFound, "fewer constraints than before cannot be inconsistent");
}

network::Constraint PartialPlan::NetworkConstraint(const GeometricConstraint& constraint) const {
  switch (constraint.kind) {
    case ConstraintKind::kMember:
    case ConstraintKind::kInPositionClass:
      return network::UnaryConstraint{
          .node = NodeOf(constraint.subject()),
          .allowed = SetOf(LabelCount(constraint.subject()), constraint.labels)};
    case ConstraintKind::kReachable:
      return network::BinaryConstraint{
          .a = NodeOf(constraint.grasp),
          .b = NodeOf(constraint.position),
          .relation = relations_->Reachable(variables_[constraint.grasp].part)};
    case ConstraintKind::kMateReachable:
      return network::BinaryConstraint{.a = NodeOf(constraint.grasp),
                                       .b = NodeOf(constraint.position),
                                       .relation = relations_->MateReachable(constraint.mating)};
  }
  ASSAY_CHECK(false, "a kind of constraint that the switch does not know");
  return network::UnaryConstraint{};
}

const GeometricConstraint& PartialPlan::ConstraintOf(const GeometricGoalRef& goal) const {
  return step(goal.consumer).geometric[goal.goal].constraint;
}

bool PartialPlan::Post(const GeometricGoalRef& goal) {
  const network::Constraint constraint = NetworkConstraint(ConstraintOf(goal));
  const auto* unary = std::get_if<network::UnaryConstraint>(&constraint);
  const auto* binary = std::get_if<network::BinaryConstraint>(&constraint);
  const Outcome outcome = unary ? network_.Restrict(unary->node, unary->allowed)
                                : network_.Post(binary->a, binary->b, binary->relation);
  if (outcome != Outcome::kFound) return false;
  satisfied_geometric_.push_back(goal);
  return true;
}

std::vector<std::string> PartialPlan::WhyRefused(const GeometricGoalRef& goal) const {
  std::vector<GeometricGoalRef> goals = satisfied_geometric_;
  goals.push_back(goal);
  std::vector<network::Constraint> constraints;
  for (const GeometricGoalRef& ref : goals) {
    constraints.push_back(NetworkConstraint(ConstraintOf(ref)));
  }
  Budget unlimited(std::numeric_limits<std::int64_t>::max());
  const network::Conflict conflict =
      network::MinimalConflict(WithoutGeometricGoals(), constraints, unlimited);
  std::vector<std::string> words;
  for (int index : conflict.constraints) words.push_back(Text(ConstraintOf(goals[index])));
  return words;
}

bool PartialPlan::IsKept(StepId consumer, PartId part) const {
  return std::ranges::count(kept_, std::pair{consumer, part}) > 0;
}

void PartialPlan::RequireMoved(StepId consumer, PartId part, const std::string& why) {
  const VariableId position = variables_.AddFree(VariableKind::kPosition, part);
  binding_.push_back(VariableId::None());
  nodes_.push_back(NodeId::None());
  ActionTemplate& action = steps_[consumer.index()];
  const int precondition = static_cast<int>(action.preconditions.size());
  required_moves_.push_back(
      {.consumer = consumer, .part = part, .precondition = precondition, .why = why});
  action.preconditions.push_back(Condition::Located(part, position));
  action.geometric.push_back({.constraint = {.kind = ConstraintKind::kMember,
                                             .position = position,
                                             .labels = AllStablePoses(problem_->part(part))},
                              .qualifies = {precondition}});
  goals_.operational.push_back({.consumer = consumer, .precondition = precondition});
  goals_.geometric.push_back(
      {.consumer = consumer, .goal = static_cast<int>(action.geometric.size()) - 1});
}

VariableId PartialPlan::ResolveIfAny(VariableId variable) const {
  return variable.IsNone() ? variable : Resolve(variable);
}

std::string PartialPlan::Text(StepId id) const {
  ActionTemplate bound = step(id);
  bound.grasp = ResolveIfAny(bound.grasp);
  bound.position = ResolveIfAny(bound.position);
  return domain::Text(*problem_, variables_, bound);
}
std::string PartialPlan::Text(const Condition& condition) const {
  Condition bound = condition;
  bound.variable = ResolveIfAny(bound.variable);
  return domain::Text(*problem_, variables_, bound);
}
std::string PartialPlan::Text(const GeometricConstraint& constraint) const {
  GeometricConstraint bound = constraint;
  bound.grasp = ResolveIfAny(bound.grasp);
  bound.position = ResolveIfAny(bound.position);
  return domain::Text(*problem_, variables_, bound);
}

}  // namespace assay::constraint_posting
