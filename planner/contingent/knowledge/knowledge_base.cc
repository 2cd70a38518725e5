#include "planner/contingent/knowledge/knowledge_base.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace assay::contingent {

KnowledgeBase::KnowledgeBase(const GroundTask& task)
    : task_(task),
      layout_(task),
      numbers_(task),
      atoms_(task),
      queries_(task, atoms_),
      progression_(task, atoms_) {}

KnowledgeState KnowledgeBase::Initial() {
  KnowledgeState state;
  state.bits.assign(layout_.size(), 0);
  state.ranges = task_.initial.ranges;
  for (const GroundLiteral& literal : task_.initial.known) layout_.SetKnown(state, literal);
  if (const InitialRelation* wrong = RelateAll(state, task_.initial.relations)) {
    throw InputError(wrong->place, "this contradicts what is known",
                     "alternatives that can hold together with the rest of init");
  }
  for (const FormulaId formula : task_.initial.sensed) layout_.SetSensed(state, formula, true);
  for (const auto& [f, error] : task_.initial.values_sensed) numbers_.Sense(state, f, error);
  // Nothing has been done so far, so the update rules describe the same point in time as init.
  if (const GroundEffect* wrong = ApplyUpdates(state, task_.initial.relations)) {
    throw InputError({task_.domain_file, wrong->place.line, wrong->place.column},
                     "this update rule contradicts what is known at first",
                     "rules that can hold together with init");
  }
  Canonicalize(state);
  return state;
}

const InitialRelation* KnowledgeBase::RelateAll(KnowledgeState& state,
                                                const std::vector<InitialRelation>& relations) {
  const auto wrong = std::ranges::find_if(relations, [&](const InitialRelation& relation) {
    return !atoms_.Relate(state, relation.literals, relation.is_inclusive);
  });
  return wrong == relations.end() ? nullptr : &*wrong;
}

bool KnowledgeBase::CanLast(const std::vector<InitialRelation>& relations, KnowledgeState state) {
  return RelateAll(state, relations) == nullptr;
}

std::optional<KnowledgeState> KnowledgeBase::After(const GroundAction& action,
                                                   const KnowledgeState& state) {
  std::optional<KnowledgeState> next = progression_.After(action.effects, state);
  if (!next) return std::nullopt;
  return Settled(std::move(*next));
}

const GroundEffect* KnowledgeBase::ApplyUpdates(KnowledgeState& state,
                                                const std::vector<InitialRelation>& lasting) {
  // States are compared after each rule, not after each round. If one rule undoes the change of
  // another, a round ends in the state in which it began, but the rules are not at rest.
  bool is_at_rest = task_.updates.empty();
  for (std::size_t round = 0; !is_at_rest; ++round) {
    is_at_rest = true;
    for (const GroundEffect& update : task_.updates) {
      if (!MayHold(update.condition, state)) continue;
      if (!Holds(update.condition, state)) {
        has_doubted_ = true;
        return &update;
      }
      std::optional<KnowledgeState> next = progression_.AfterCertain(update, state);
      if (!next || !CanLast(lasting, *next)) return &update;
      Canonicalize(*next);
      if (*next == state) continue;
      state = std::move(*next);
      is_at_rest = false;
      if (round == MostRoundsOf(task_)) FailRestless(update, round);
    }
  }
  return nullptr;
}

void KnowledgeBase::FailRestless(const GroundEffect& update, std::size_t rounds) const {
  throw InputError({task_.domain_file, update.place.line, update.place.column},
                   fmt::format("the update rules still change knowledge after {} rounds, and this "
                               "rule is one of those that do",
                               rounds),
                   "rules that do not undo what others do");
}

std::optional<KnowledgeState> KnowledgeBase::Settled(KnowledgeState state) {
  if (ApplyUpdates(state) != nullptr) return std::nullopt;
  Canonicalize(state);
  return state;
}

void KnowledgeBase::Canonicalize(KnowledgeState& state) const {
  std::sort(state.relations.begin(), state.relations.end());
  layout_.DisentangleKnown(state);
  for (std::size_t f = 0; f < task_.formulas.size(); ++f) {
    const FormulaId formula(f);
    if (layout_.IsSensed(state, formula) && queries_.IsDetermined(task_.formulas[f], state)) {
      layout_.SetSensed(state, formula, false);
    }
  }
  for (std::size_t f = 0; f < task_.functions.size(); ++f) {
    const FunctionId function(f);
    if (layout_.IsSensed(state, function) && queries_.IsDetermined(function, state)) {
      layout_.SetSensed(state, function, false);
    }
  }
}

// ---- Branches

std::vector<GroundLiteral> KnowledgeBase::UndeterminedLiterals(FormulaId formula,
                                                               const KnowledgeState& state) const {
  std::vector<GroundLiteral> literals = task_.formulas[formula.index()].literals;
  std::erase_if(literals, [&](const GroundLiteral& literal) {
    return !layout_.IsUndetermined(state, literal.atom);
  });
  return literals;
}

FormulaId KnowledgeBase::FormulaToBranch(const KnowledgeState& state) const {
  for (std::size_t f = 0; f < task_.formulas.size(); ++f) {
    if (layout_.IsSensed(state, FormulaId(f))) return FormulaId(f);
  }
  return FormulaId::None();
}

std::vector<AtomId> KnowledgeBase::PossibleValues(FunctionId function,
                                                  const KnowledgeState& state) const {
  std::vector<AtomId> possible;
  for (const AtomId value : task_.functions[function.index()].values) {
    if (!layout_.IsKnown(state, {value, false})) possible.push_back(value);
  }
  return possible;
}

std::vector<FunctionId> KnowledgeBase::FunctionsToBranch(const KnowledgeState& state) {
  std::vector<FunctionId> functions;
  for (std::size_t f = 0; f < task_.functions.size(); ++f) {
    const FunctionId function(f);
    if (!layout_.IsSensed(state, function) || numbers_.IsNumber(function)) continue;
    std::vector<GroundLiteral> values;
    for (const AtomId value : PossibleValues(function, state)) values.push_back({value, true});
    if (IsWithin(state, worlds().WhereOne(values, true))) functions.push_back(function);
  }
  return functions;
}

std::optional<KnowledgeState> KnowledgeBase::Learned(const KnowledgeState& state, FormulaId formula,
                                                     bool value) {
  KnowledgeState next = state;
  if (const std::optional<Bound>& bound = task_.formulas[formula.index()].bound) {
    if (numbers_.RangeOf(bound->function, next).is_outer) atoms_.LearnOfNumbers(next);
    numbers_.Learn(next, value ? *bound : Negation(*bound));
  } else if (!atoms_.LearnConjunction(next, task_.formulas[formula.index()].literals, value)) {
    return std::nullopt;
  }
  return Settled(std::move(next));
}

std::optional<KnowledgeState> KnowledgeBase::Learned(const KnowledgeState& state,
                                                     GroundLiteral literal) {
  KnowledgeState next = state;
  atoms_.Learn(next, literal);
  return Settled(std::move(next));
}

}  // namespace assay::contingent
