#include "planner/contingent/knowledge/knowledge_space.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "planner/contingent/grounding/ground_query.h"

namespace assay::contingent {

PlanNode NodeOf(const Transition& transition, const std::vector<NodeId>& children) {
  PlanNode node;
  node.kind = transition.step.kind;
  node.action = transition.step.action;
  node.formula = transition.step.formula;
  node.function = transition.step.function;
  node.values = transition.values;
  node.children = children;
  return node;
}

KnowledgeSpace::KnowledgeSpace(const GroundTask& task, Budget& budget)
    : knowledge_(task),
      budget_(budget),
      asks_for_ignorance_(AsksForIgnorance(task)),
      functions_asked_for_(FunctionsAskedFor(task)) {}

const std::string& KnowledgeSpace::doubt() {
  if (doubt_.empty() && knowledge_.has_doubted()) {
    doubt_ = "for some actions it is undecided whether their effects happen";
  }
  return doubt_;
}

bool KnowledgeSpace::Surely(const GroundQuery& query, const KnowledgeState& state) {
  if (knowledge_.Holds(query, state)) return true;
  if (knowledge_.MayHold(query, state)) {
    doubt_ =
        "the planner does not store relations between numbers, or between numbers and facts, and a "
        "query may depend on them";
  }
  return false;
}

StateId KnowledgeSpace::initial() { return Intern(knowledge_.Initial()); }

StateId KnowledgeSpace::Intern(KnowledgeState state) {
  const std::uint64_t hash = HashOf(state);
  const int found = ids_.Find(hash, [&](int index) { return states_[index] == state; });
  if (found >= 0) return StateId(found);
  const StateId id(states_.size());
  states_.push_back(std::move(state));
  ids_.Insert(hash, id.index());
  return id;
}

bool KnowledgeSpace::AddOutcome(std::optional<KnowledgeState> state, Transition& transition) {
  if (state) transition.outcomes.push_back(Intern(std::move(*state)));
  return state.has_value();
}

KnowledgeSpace::Expansion& KnowledgeSpace::ExpansionOf(StateId id) {
  const auto [entry, is_new] = expansions_.try_emplace(id);
  Expansion& expansion = entry->second;
  if (is_new) {
    expansion.steps = FindSteps(id);
    expansion.transitions.resize(expansion.steps.size());
    expansion.is_tried.resize(expansion.steps.size(), false);
  }
  return expansion;
}

const std::vector<Step>& KnowledgeSpace::StepsFrom(StateId id) {
  budget_.Spend();
  return ExpansionOf(id).steps;
}

const Transition* KnowledgeSpace::Take(StateId id, std::size_t step) {
  Expansion& expansion = ExpansionOf(id);
  if (!expansion.is_tried[step]) {
    expansion.is_tried[step] = true;
    expansion.transitions[step] = Try(id, expansion.steps[step]);
  }
  return expansion.transitions[step] ? &*expansion.transitions[step] : nullptr;
}

std::vector<Step> KnowledgeSpace::FindSteps(StateId id) {
  const KnowledgeState& from = state(id);
  const FormulaId formula = knowledge_.FormulaToBranch(from);
  if (!formula.IsNone()) {
    if (asks_for_ignorance_) {
      doubt_ =
          "the planner branches on each sensor result at once, but a query requires that something "
          "is unknown";
    }
    return {{.kind = PlanNode::Kind::kWhether, .formula = formula}};
  }
  std::vector<Step> steps;
  for (const FunctionId function : knowledge_.FunctionsToBranch(from)) {
    steps.push_back({.kind = PlanNode::Kind::kValue, .function = function});
  }
  DoubtValuesBeyond(steps, from);
  for (std::size_t a = 0; a < task().actions.size(); ++a) {
    if (Surely(task().actions[a].precondition, from)) {
      steps.push_back({.kind = PlanNode::Kind::kAct, .action = ActionId(a)});
    }
  }
  return steps;
}

void KnowledgeSpace::DoubtValuesBeyond(const std::vector<Step>& branches,
                                       const KnowledgeState& from) {
  for (const FunctionId function : functions_asked_for_) {
    if (!knowledge_.IsInKv(function, from) ||
        std::ranges::count(branches, function, &Step::function) > 0) {
      continue;
    }
    doubt_ = fmt::format(
        "a query asks for the sensed value of {}, and the planner branches on a value only if Kx "
        "lists all values",
        task().functions[function.index()].text);
  }
}

std::optional<Transition> KnowledgeSpace::Try(StateId id, const Step& step) {
  Transition transition{.step = step};
  switch (step.kind) {
    case PlanNode::Kind::kGoal:
      return std::nullopt;
    case PlanNode::Kind::kAct: {
      auto after = knowledge_.After(task().actions[step.action.index()], state(id));
      if (!after || *after == state(id)) return std::nullopt;
      transition.outcomes = {Intern(std::move(*after))};
      break;
    }
    case PlanNode::Kind::kWhether:
      for (const bool value : {true, false}) {
        if (!AddOutcome(knowledge_.Learned(state(id), step.formula, value), transition)) {
          return std::nullopt;
        }
      }
      break;
    case PlanNode::Kind::kValue:
      transition.values = knowledge_.PossibleValues(step.function, state(id));
      for (const AtomId value : transition.values) {
        if (!AddOutcome(knowledge_.Learned(state(id), {value, true}), transition)) {
          return std::nullopt;
        }
      }
      break;
  }
  return transition;
}

}  // namespace assay::contingent
