#include "planner/contingent/search/requirement.h"

#include <algorithm>

#include "planner/contingent/grounding/ground_query.h"

namespace assay::contingent {

Regression::Regression(KnowledgeSpace& space)
    : space_(space),
      knowledge_(space.knowledge()),
      worlds_(knowledge_.worlds()),
      first_formula_(task().atoms.size()),
      first_function_(first_formula_ + task().formulas.size()),
      first_range_(first_function_ + task().functions.size()),
      aspects_(first_range_ + task().function_of_slot.size()) {}

void Regression::Keep(Requirement& requirement, std::size_t aspect) const {
  if (requirement.same.empty()) requirement.same.resize(aspects_, false);
  requirement.same[aspect] = true;
}

void Regression::KeepAll(Requirement& requirement, const std::vector<bool>& same) const {
  for (std::size_t i = 0; i < same.size(); ++i) {
    if (same[i]) Keep(requirement, i);
  }
}

Requirement Regression::OfGoal(StateId state) {
  Requirement requirement;
  Require(task().goal, state, requirement);
  return requirement;
}

Requirement Regression::OfStep(StateId state, const Transition& transition,
                               const std::vector<const Requirement*>& after) {
  std::vector<Requirement> settled;
  for (std::size_t i = 0; i < after.size(); ++i) {
    settled.push_back(BeforeUpdates(*after[i], transition.outcomes[i]));
  }
  switch (transition.step.kind) {
    case PlanNode::Kind::kGoal:
      return OfGoal(state);
    case PlanNode::Kind::kAct:
      return OfAction(state, task().actions[transition.step.action.index()], settled[0]);
    case PlanNode::Kind::kWhether:
      return OfFormula(state, transition.step.formula, settled[0], settled[1]);
    case PlanNode::Kind::kValue:
      return OfValue(state, transition, settled);
  }
  return {};
}

// Update rules depend on what is known. All aspects that the conditions of the rules ask about are
// kept, so that the rules make the same changes.
Requirement Regression::BeforeUpdates(const Requirement& after, StateId outcome) {
  Requirement before = after;
  for (const GroundEffect& update : task().updates) {
    KeepAsked(update.condition, before);
    for (const GroundChange& change : update.changes) {
      if (!change.formula.IsNone()) Keep(before, AspectOf(change.formula));
      if (!change.function.IsNone()) Keep(before, AspectOf(change.function));
      const bool is_number = change.kind == GroundChange::Kind::kAssign ||
                             change.kind == GroundChange::Kind::kForgetNumber;
      if (is_number) Keep(before, AspectOfRange(change.function));
      if (!change.bound.function.IsNone()) Keep(before, AspectOfRange(change.bound.function));
      for (const GroundLiteral& l : change.literals) Keep(before, AspectOf(l.atom));
      for (const auto& [function, sign] : change.sum.functions) {
        Keep(before, AspectOfRange(function));
      }
      if (change.literal.atom.IsNone()) continue;
      const AtomId atom = change.literal.atom;
      Keep(before, AspectOf(atom));
      for (const bool value : {true, false}) {
        if (!knowledge_.layout().IsKnown(space_.state(outcome), {atom, value})) continue;
        before.worlds = worlds_.Cofactor(before.worlds, {worlds_.Variable(atom), value});
      }
    }
  }
  return before;
}

// ---- Queries

void Regression::Require(const GroundQuery& query, StateId state, Requirement& requirement) {
  const KnowledgeState& here = space_.state(state);
  switch (query.kind) {
    case GroundQuery::Kind::kAnd:
      for (const GroundQuery& operand : query.operands) Require(operand, state, requirement);
      return;
    case GroundQuery::Kind::kOr: {
      // K(a) | K(b) is stronger than K(a | b). The requirement takes one disjunct that holds in
      // this state.
      const auto holding =
          std::find_if(query.operands.begin(), query.operands.end(),
                       [&](const GroundQuery& operand) { return knowledge_.Holds(operand, here); });
      if (holding != query.operands.end()) Require(*holding, state, requirement);
      return;
    }
    case GroundQuery::Kind::kKnown:
      requirement.worlds = worlds_.And(requirement.worlds, worlds_.Where(query.literal));
      return;
    case GroundQuery::Kind::kKnownWhether:
      if (!knowledge_.layout().IsSensed(here, query.formula)) {
        RequireDetermined(query.formula, here, requirement);
        return;
      }
      [[fallthrough]];
    case GroundQuery::Kind::kNot:
    case GroundQuery::Kind::kBoundKnown:
    case GroundQuery::Kind::kValueSensed:
      KeepAsked(query, requirement);
      return;
  }
}

void Regression::RequireDetermined(FormulaId formula, const KnowledgeState& here,
                                   Requirement& requirement) {
  const Formula& determined = task().formulas[formula.index()];
  if (determined.bound) return Keep(requirement, AspectOfRange(determined.bound->function));
  const Diagram holds = worlds_.WhereAll(determined.literals);
  const Diagram where = knowledge_.IsWithin(here, holds) ? holds : worlds_.Not(holds);
  requirement.worlds = worlds_.And(requirement.worlds, where);
}

void Regression::KeepAsked(const GroundQuery& query, Requirement& requirement) const {
  switch (query.kind) {
    case GroundQuery::Kind::kKnown:
      return Keep(requirement, AspectOf(query.literal.atom));
    case GroundQuery::Kind::kKnownWhether:
      KeepDetermining(query.formula, requirement);
      return Keep(requirement, AspectOf(query.formula));
    case GroundQuery::Kind::kValueSensed:
      if (task().functions[query.function.index()].slot >= 0) {
        Keep(requirement, AspectOfRange(query.function));
      }
      return Keep(requirement, AspectOf(query.function));
    case GroundQuery::Kind::kBoundKnown:
      return Keep(requirement, AspectOfRange(query.bound.function));
    case GroundQuery::Kind::kAnd:
    case GroundQuery::Kind::kOr:
    case GroundQuery::Kind::kNot:
      for (const GroundQuery& operand : query.operands) KeepAsked(operand, requirement);
      return;
  }
}

void Regression::KeepDetermining(FormulaId formula, Requirement& requirement) const {
  const Formula& asked = task().formulas[formula.index()];
  if (asked.bound) Keep(requirement, AspectOfRange(asked.bound->function));
  for (const GroundLiteral& literal : asked.literals) Keep(requirement, AspectOf(literal.atom));
}

// ---- Actions

Requirement Regression::OfAction(StateId state, const GroundAction& action,
                                 const Requirement& after) {
  Requirement before;
  RegressWorlds(action, state, after, before);
  for (const GroundEffect& effect : action.effects) {
    if (!effect.is_of_worlds || HasBound(effect.condition)) KeepAsked(effect.condition, before);
  }
  RegressAspects(action, WithAsserted(action, after), before);
  Require(action.precondition, state, before);
  return before;
}

// A relation or a bound that an action asserts must not contradict the knowledge. A world that it
// excludes needs no plan, but at least one world must remain. The aspects that the relation or
// bound is about are therefore kept.
Requirement Regression::WithAsserted(const GroundAction& action, const Requirement& after) const {
  Requirement asserted = after;
  for (const GroundEffect& effect : action.effects) {
    for (const GroundChange& change : effect.changes) {
      const bool is_asserted =
          change.kind == GroundChange::Kind::kRelate || change.kind == GroundChange::Kind::kNarrow;
      for (const std::size_t aspect : AspectsOf(change)) {
        if (is_asserted) Keep(asserted, aspect);
      }
    }
  }
  return asserted;
}

// After the action, an atom is true where an effect has made it true, or where it was true before
// and no effect has made it false. The action is not taken where it may give a function two values.
void Regression::RegressWorlds(const GroundAction& action, StateId state, const Requirement& after,
                               Requirement& before) {
  OpenBounds bounds(task(), space_.state(state), worlds_);
  const Happening happening = WhatHappens(action, state, bounds);
  Diagram required = worlds_.Or(after.worlds, worlds_.Not(happening.asserted));
  for (const int forgotten : happening.forgotten) required = worlds_.ForAll(required, forgotten);
  required = worlds_.Compose(required, ValuesAfter(happening));
  required = worlds_.And(required, worlds_.Not(WhereTwoValues(task(), happening.changes, worlds_)));
  required = worlds_.Or(required, worlds_.Not(bounds.Together()));
  for (const int bound : bounds.Variables()) required = worlds_.ForAll(required, bound);
  before.worlds = required;
}

Regression::Happening Regression::WhatHappens(const GroundAction& action, StateId state,
                                              OpenBounds& bounds) {
  Happening happening;
  for (const GroundEffect& effect : action.effects) {
    const bool happens = knowledge_.Holds(effect.condition, space_.state(state));
    if (!happens && !effect.is_of_worlds) continue;
    const Diagram where = effect.is_of_worlds ? worlds_.Where(effect.condition, bounds) : kAllSets;
    for (const GroundChange& change : effect.changes) {
      if (change.kind == GroundChange::Kind::kForget) {
        happening.forgotten.push_back(worlds_.Variable(change.literal.atom));
      }
      if (change.kind == GroundChange::Kind::kRelate && happens) {
        const Diagram asserted = worlds_.WhereOne(change.literals, change.is_inclusive);
        happening.asserted = worlds_.And(happening.asserted, asserted);
      }
      happening.changes.emplace_back(&change, where);
    }
  }
  return happening;
}

std::unordered_map<int, Diagram> Regression::ValuesAfter(const Happening& happening) {
  std::unordered_map<int, Diagram> becomes_true;
  std::unordered_map<int, Diagram> becomes_false;
  for (const auto& [change, where] : happening.changes) {
    if (change->kind != GroundChange::Kind::kSet) continue;
    auto& becomes = change->literal.is_positive ? becomes_true : becomes_false;
    Diagram& there = becomes[worlds_.Variable(change->literal.atom)];
    there = worlds_.Or(there, where);
  }
  std::unordered_map<int, Diagram> after = becomes_true;
  for (const auto& [variable, where] : becomes_false) after.try_emplace(variable, kEmptySet);
  for (auto& [variable, value] : after) {
    const auto falsified = becomes_false.find(variable);
    const Diagram stays =
        falsified != becomes_false.end() ? worlds_.Not(falsified->second) : kAllSets;
    value = worlds_.Or(value, worlds_.And(worlds_.Literal({variable, true}), stays));
  }
  return after;
}

// Returns the aspects of a state that the change is about.
std::vector<std::size_t> Regression::AspectsOf(const GroundChange& change) const {
  std::vector<std::size_t> aspects;
  switch (change.kind) {
    case GroundChange::Kind::kSet:
    case GroundChange::Kind::kForget:
      return {AspectOf(change.literal.atom)};
    case GroundChange::Kind::kSense:
    case GroundChange::Kind::kUnsense:
      return {AspectOf(change.formula)};
    case GroundChange::Kind::kSenseValue:
    case GroundChange::Kind::kUnsenseValue:
      return {AspectOf(change.function)};
    case GroundChange::Kind::kAssign:
    case GroundChange::Kind::kForgetNumber:
      return {AspectOf(change.function), AspectOfRange(change.function)};
    case GroundChange::Kind::kRelate:
      for (const GroundLiteral& l : change.literals) aspects.push_back(AspectOf(l.atom));
      return aspects;
    case GroundChange::Kind::kNarrow:
      return {AspectOfRange(change.bound.function)};
  }
  return {};
}

// Returns true if the change determines these aspects whatever they were before. A sensor's error
// is the least error so far, and asserted facts are added to earlier knowledge, so these changes do
// not determine the sensor's error and the asserted facts.
bool Regression::Settles(const GroundChange& change) const {
  return change.kind != GroundChange::Kind::kRelate && change.kind != GroundChange::Kind::kNarrow &&
         (change.kind != GroundChange::Kind::kSenseValue ||
          task().functions[change.function.index()].slot < 0);
}

// An aspect that is kept after the action and that an unconditional effect sets is determined by
// the action. A conditional effect makes the aspect depend on the effect's condition.
void Regression::RegressAspects(const GroundAction& action, const Requirement& after,
                                Requirement& before) {
  if (after.same.empty()) return;
  std::vector<bool> same = after.same;
  for (const GroundEffect& effect : action.effects) {
    for (const GroundChange& change : effect.changes) {
      for (const std::size_t aspect : AspectsOf(change)) {
        if (!after.same[aspect]) continue;
        if (!effect.condition.IsTrue()) KeepAsked(effect.condition, before);
        if (effect.condition.IsTrue() && Settles(change)) same[aspect] = false;
        for (const auto& [function, sign] : change.sum.functions) {
          Keep(before, AspectOfRange(function));
        }
      }
    }
  }
  KeepAll(before, same);
}

// ---- Branches

void Regression::KeepRelation(AtomId atom, StateId state, Requirement& requirement) {
  if (requirement.same.empty()) return;
  const Diagram relation = knowledge_.RelationOf(space_.state(state), atom);
  for (const int variable : worlds_.Support(relation)) {
    if (Keeps(requirement, AspectOf(worlds_.AtomOf(variable)))) {
      Keep(requirement, AspectOf(atom));
      return;
    }
  }
}

Requirement Regression::OfFormula(StateId state, FormulaId formula, const Requirement& if_true,
                                  const Requirement& if_false) {
  Requirement before;
  KeepAll(before, if_true.same);
  KeepAll(before, if_false.same);
  const Formula& asked = task().formulas[formula.index()];
  if (asked.bound) {
    before.worlds = worlds_.And(if_true.worlds, if_false.worlds);
    Keep(before, AspectOfRange(asked.bound->function));
  } else {
    for (const GroundLiteral& literal : asked.literals) {
      KeepRelation(literal.atom, state, before);
      // A conjunction branches as long as one of its literals is undetermined.
      if (asked.literals.size() > 1) Keep(before, AspectOf(literal.atom));
    }
    before.worlds =
        worlds_.IfThenElse(worlds_.WhereAll(asked.literals), if_true.worlds, if_false.worlds);
  }
  Keep(before, AspectOf(formula));
  return before;
}

Requirement Regression::OfValue(StateId state, const Transition& transition,
                                const std::vector<Requirement>& after) {
  Requirement before;
  before.worlds = kEmptySet;
  for (std::size_t i = 0; i < transition.values.size(); ++i) {
    KeepAll(before, after[i].same);
    const Diagram where = worlds_.Where(GroundLiteral{transition.values[i], true});
    before.worlds = worlds_.Or(before.worlds, worlds_.And(where, after[i].worlds));
  }
  // The branches must be the same in both states.
  for (const AtomId value : transition.values) {
    Keep(before, AspectOf(value));
    KeepRelation(value, state, before);
  }
  Keep(before, AspectOf(transition.step.function));
  return before;
}

// ---- Reuse

bool Regression::Suits(const Requirement& requirement, StateId made_in, StateId other) {
  const KnowledgeState& there = space_.state(made_in);
  const KnowledgeState& here = space_.state(other);
  const StateLayout& layout = knowledge_.layout();
  for (std::size_t i = 0; i < requirement.same.size(); ++i) {
    if (!requirement.same[i]) continue;
    if (i < first_formula_) {
      const AtomId atom(i);
      if (layout.IsKnown(there, {atom, true}) != layout.IsKnown(here, {atom, true}) ||
          layout.IsKnown(there, {atom, false}) != layout.IsKnown(here, {atom, false}) ||
          layout.IsEntangled(there, atom) != layout.IsEntangled(here, atom) ||
          layout.IsOuter(there, atom) != layout.IsOuter(here, atom) ||
          knowledge_.RelationOf(there, atom) != knowledge_.RelationOf(here, atom)) {
        return false;
      }
    } else if (i < first_function_) {
      const FormulaId formula(i - first_formula_);
      if (layout.IsSensed(there, formula) != layout.IsSensed(here, formula)) return false;
    } else if (i < first_range_) {
      const FunctionId function(i - first_function_);
      const int slot = task().functions[function.index()].slot;
      if (layout.IsSensed(there, function) != layout.IsSensed(here, function)) return false;
      if (slot >= 0 && there.ranges[slot].error != here.ranges[slot].error) return false;
    } else if (there.ranges[i - first_range_] != here.ranges[i - first_range_]) {
      return false;
    }
  }
  return knowledge_.IsWithin(here, requirement.worlds);
}

}  // namespace assay::contingent
