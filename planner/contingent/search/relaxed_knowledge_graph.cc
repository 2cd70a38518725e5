#include "planner/contingent/search/relaxed_knowledge_graph.h"

#include <algorithm>

namespace assay::contingent {
namespace {

constexpr int kNotReached = RelaxedPlan::kUnreached;
// Exclusive alternatives settle each other. In a list of more alternatives than this, only the last
// remaining alternative is settled.
constexpr std::size_t kShortList = 8;

}  // namespace

RelaxedKnowledgeGraph::RelaxedKnowledgeGraph(const GroundTask& task)
    : task_(task),
      layout_(task),
      first_formula_(2 * static_cast<int>(task.atoms.size())),
      first_function_(first_formula_ + static_cast<int>(task.formulas.size())),
      propositions_(first_function_ + static_cast<int>(task.functions.size())) {
  for (std::size_t a = 0; a < task.actions.size(); ++a) {
    std::vector<Proposition> preconditions;
    AddNeeds(task.actions[a].precondition, preconditions);
    AddEffects(task.actions[a].effects, preconditions, ActionId(a));
  }
  AddEffects(task.updates, {}, ActionId::None());
  for (const InitialRelation& relation : task.initial.relations) AddRelation(relation);
  AddSensing(task);
  AddNeeds(task.goal, goal_);
  needed_by_.resize(propositions_);
  for (std::size_t op = 0; op < operators_.size(); ++op) {
    for (const Proposition p : operators_[op].preconditions) {
      needed_by_[p].push_back(static_cast<int>(op));
    }
    if (operators_[op].preconditions.empty()) always_.push_back(static_cast<int>(op));
  }
}

void RelaxedKnowledgeGraph::AddOperator(std::vector<Proposition> preconditions,
                                        std::vector<Proposition> additions, ActionId action) {
  std::sort(preconditions.begin(), preconditions.end());
  preconditions.erase(std::unique(preconditions.begin(), preconditions.end()), preconditions.end());
  operators_.push_back({std::move(preconditions), std::move(additions), action});
}

void RelaxedKnowledgeGraph::AddNeeds(const GroundQuery& query, std::vector<Proposition>& needs) {
  switch (query.kind) {
    case GroundQuery::Kind::kKnown:
      needs.push_back(Known(query.literal));
      return;
    case GroundQuery::Kind::kKnownWhether:
      needs.push_back(Sensed(query.formula));
      return;
    case GroundQuery::Kind::kValueSensed:
      needs.push_back(Sensed(query.function));
      return;
    case GroundQuery::Kind::kAnd:
      for (const GroundQuery& operand : query.operands) AddNeeds(operand, needs);
      return;
    case GroundQuery::Kind::kOr: {
      const Proposition any = propositions_++;
      needs.push_back(any);
      for (const GroundQuery& operand : query.operands) {
        std::vector<Proposition> of_operand;
        AddNeeds(operand, of_operand);
        AddOperator(std::move(of_operand), {any}, ActionId::None());
      }
      return;
    }
    case GroundQuery::Kind::kNot:
    case GroundQuery::Kind::kBoundKnown:
      return;
  }
}

void RelaxedKnowledgeGraph::AddEffects(const std::vector<GroundEffect>& effects,
                                       const std::vector<Proposition>& preconditions,
                                       ActionId action) {
  std::vector<Proposition> unconditional;
  for (const GroundEffect& effect : effects) {
    std::vector<Proposition> additions = AdditionsOf(effect);
    if (effect.condition.IsTrue()) {
      unconditional.insert(unconditional.end(), additions.begin(), additions.end());
      continue;
    }
    std::vector<Proposition> needs = preconditions;
    AddNeeds(effect.condition, needs);
    AddOperator(std::move(needs), std::move(additions), action);
  }
  if (!unconditional.empty()) AddOperator(preconditions, std::move(unconditional), action);
}

std::vector<RelaxedKnowledgeGraph::Proposition> RelaxedKnowledgeGraph::AdditionsOf(
    const GroundEffect& effect) const {
  std::vector<Proposition> additions;
  for (const GroundChange& change : effect.changes) {
    if (change.kind == GroundChange::Kind::kSet) additions.push_back(Known(change.literal));
    if (change.kind == GroundChange::Kind::kSense) additions.push_back(Sensed(change.formula));
    if (change.kind == GroundChange::Kind::kSenseValue) {
      additions.push_back(Sensed(change.function));
    }
  }
  return additions;
}

void RelaxedKnowledgeGraph::AddRelation(const InitialRelation& relation) {
  const std::vector<GroundLiteral>& literals = relation.literals;
  for (const GroundLiteral& last : literals) {
    std::vector<Proposition> others;
    for (const GroundLiteral& l : literals) {
      if (l != last) others.push_back(Known({l.atom, !l.is_positive}));
    }
    AddOperator(std::move(others), {Known(last)}, ActionId::None());
    if (relation.is_inclusive || literals.size() > kShortList) continue;
    for (const GroundLiteral& l : literals) {
      if (l == last) continue;
      AddOperator({Known(last)}, {Known({l.atom, !l.is_positive})}, ActionId::None());
    }
  }
}

void RelaxedKnowledgeGraph::AddSensing(const GroundTask& task) {
  for (std::size_t f = 0; f < task.formulas.size(); ++f) {
    std::vector<Proposition> outcomes;
    for (const GroundLiteral& l : task.formulas[f].literals) {
      outcomes.push_back(Known(l));
      outcomes.push_back(Known({l.atom, !l.is_positive}));
    }
    AddOperator({Sensed(FormulaId(f))}, std::move(outcomes), ActionId::None());
  }
  for (std::size_t f = 0; f < task.functions.size(); ++f) {
    std::vector<Proposition> outcomes;
    for (const AtomId value : task.functions[f].values) outcomes.push_back(Known({value, true}));
    AddOperator({Sensed(FunctionId(f))}, std::move(outcomes), ActionId::None());
  }
}

void RelaxedKnowledgeGraph::Improve(Proposition proposition, int cost, int by) {
  if (cost >= cost_[proposition]) return;
  cost_[proposition] = cost;
  best_[proposition] = by;
  if (static_cast<std::size_t>(cost) >= queue_.size()) queue_.resize(cost + 1);
  queue_[cost].push_back(proposition);
}

void RelaxedKnowledgeGraph::Fire(int op) {
  const Operator& fired = operators_[op];
  const int cost = std::min(sum_[op] + (fired.action.IsNone() ? 0 : 1), kNotReached - 1);
  for (const Proposition added : fired.additions) Improve(added, cost, op);
}

void RelaxedKnowledgeGraph::ComputeCosts(const KnowledgeState& state) {
  cost_.assign(propositions_, kNotReached);
  best_.assign(propositions_, -1);
  sum_.assign(operators_.size(), 0);
  missing_.resize(operators_.size());
  for (std::size_t op = 0; op < operators_.size(); ++op) {
    missing_[op] = static_cast<int>(operators_[op].preconditions.size());
  }
  queue_.clear();
  for (std::size_t a = 0; a < task_.atoms.size(); ++a) {
    for (const bool value : {true, false}) {
      const GroundLiteral literal{AtomId(a), value};
      if (layout_.IsKnown(state, literal)) Improve(Known(literal), 0, -1);
    }
  }
  for (std::size_t f = 0; f < task_.formulas.size(); ++f) {
    if (layout_.IsSensed(state, FormulaId(f))) Improve(Sensed(FormulaId(f)), 0, -1);
  }
  for (std::size_t f = 0; f < task_.functions.size(); ++f) {
    if (layout_.IsSensed(state, FunctionId(f))) Improve(Sensed(FunctionId(f)), 0, -1);
  }
  for (const int op : always_) Fire(op);
  for (std::size_t cost = 0; cost < queue_.size(); ++cost) {
    for (std::size_t i = 0; i < queue_[cost].size(); ++i) {
      const Proposition p = queue_[cost][i];
      if (cost_[p] != static_cast<int>(cost)) continue;  // it was reached at a lower cost since
      for (const int op : needed_by_[p]) {
        sum_[op] += cost_[p];
        if (--missing_[op] == 0) Fire(op);
      }
    }
  }
}

RelaxedPlan RelaxedKnowledgeGraph::PlanFrom(const KnowledgeState& state) {
  ComputeCosts(state);
  RelaxedPlan plan;
  plan.actions = 0;
  std::vector<Proposition> open = goal_;
  std::vector<bool> is_open(propositions_, false);
  std::vector<bool> is_used(task_.actions.size(), false);
  for (const Proposition p : open) is_open[p] = true;
  while (!open.empty()) {
    const Proposition p = open.back();
    open.pop_back();
    if (cost_[p] >= kNotReached - 1) return {};
    if (best_[p] < 0) continue;
    const Operator& op = operators_[best_[p]];
    if (!op.action.IsNone() && !is_used[op.action.index()]) {
      is_used[op.action.index()] = true;
      ++plan.actions;
      if (sum_[best_[p]] == 0) plan.helpful.push_back(op.action);
    }
    for (const Proposition needed : op.preconditions) {
      if (is_open[needed]) continue;
      is_open[needed] = true;
      open.push_back(needed);
    }
  }
  std::sort(plan.helpful.begin(), plan.helpful.end());
  return plan;
}

}  // namespace assay::contingent
