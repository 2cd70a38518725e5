#include "planner/contingent/grounding/effect_grounding.h"

#include <algorithm>
#include <utility>

#include "planner/contingent/grounding/ground_query.h"

namespace assay::contingent {

void EffectGrounding::AddEffects(const Effect& effect, Bindings bindings,
                                 std::vector<GroundEffect>& to) {
  terms_.ForEachBinding(effect.variables, bindings, 0, [&] {
    const GroundQuery condition = queries_.QueryOf(effect.condition, bindings);
    if (condition.IsFalse()) return;
    GroundEffect ground{condition, AsksOfTheWorld(condition), {}, effect.place};
    for (const Change& change : effect.changes) {
      for (GroundChange& made : ChangesOf(change, bindings)) {
        ground.changes.push_back(std::move(made));
      }
    }
    if (!ground.changes.empty()) to.push_back(std::move(ground));
  });
}

std::vector<GroundChange> EffectGrounding::ChangesOf(const Change& change,
                                                     const Bindings& bindings) {
  switch (change.store) {
    case Store::kFacts:
      return FactChanges(change, bindings);
    case Store::kWhether:
      return WhetherChanges(change.literals, change.is_addition, bindings);
    case Store::kValues:
      return {{.kind = change.is_addition ? GroundChange::Kind::kSenseValue
                                          : GroundChange::Kind::kUnsenseValue,
               .function = terms_.FunctionOf(change.terms.front(), bindings),
               .error = change.within.value_or(0)}};
    case Store::kExclusive:
      return RelationChanges(change, bindings);
    case Store::kClosed:
      return ClosedChanges(change, bindings);
  }
  return {};
}

std::vector<GroundChange> EffectGrounding::FactChanges(const Change& change,
                                                       const Bindings& bindings) {
  const Literal& literal = change.literals.front();
  if (literal.relation == Relation::kPredicate) {
    const AtomId atom =
        terms_.table().Atom(literal.predicate, terms_.Constants(literal.arguments, bindings));
    return {{.kind = change.is_addition ? GroundChange::Kind::kSet : GroundChange::Kind::kForget,
             .literal = {atom, literal.is_positive}}};
  }
  const bool is_left = literal.arguments[0].kind == Term::Kind::kFunction;
  const Term& function = literal.arguments[is_left ? 0 : 1];
  if (terms_.IsNumeric(function)) return NumberChanges(change, literal, bindings);
  return ValueChanges(change, terms_.FunctionOf(function, bindings),
                      terms_.ValueOf(literal.arguments[is_left ? 1 : 0], bindings), literal);
}

// A function has one value. When one value becomes true, the others become false. When one value
// becomes unknown, the others become unknown, too. A function's value at run time can be forgotten
// but not set.
std::vector<GroundChange> EffectGrounding::ValueChanges(const Change& change, FunctionId id,
                                                        const GroundValue& value,
                                                        const Literal& literal) {
  std::vector<GroundChange> changes;
  const bool is_of_run_time = !value.function.IsNone();
  if (is_of_run_time && (value.function != id || change.is_addition)) {
    terms_.Refuse();
    return changes;
  }
  if (is_of_run_time) {
    for (const AtomId atom : terms_.task().functions[id.index()].values) {
      changes.push_back({.kind = GroundChange::Kind::kForget, .literal = {atom, true}});
    }
    return changes;
  }
  const AtomId atom = terms_.table().Value(id, value.text);
  if (atom.IsNone()) {
    // the function has no such value
    if (literal.is_positive && change.is_addition) terms_.Refuse();
    return changes;
  }
  if (change.is_addition && !literal.is_positive) {
    return {{.kind = GroundChange::Kind::kSet, .literal = {atom, false}}};
  }
  for (const AtomId other : terms_.task().functions[id.index()].values) {
    changes.push_back(
        {.kind = change.is_addition ? GroundChange::Kind::kSet : GroundChange::Kind::kForget,
         .literal = {other, other == atom}});
  }
  return changes;
}

std::vector<GroundChange> EffectGrounding::NumberChanges(const Change& change,
                                                         const Literal& literal,
                                                         const Bindings& bindings) {
  const FunctionId function = terms_.FunctionOf(literal.arguments[0], bindings);
  if (!change.is_addition) {
    return {{.kind = GroundChange::Kind::kForgetNumber, .function = function}};
  }
  const GroundSum sum = terms_.SumOf(literal.arguments[1], bindings);
  if (literal.relation == Relation::kEqual) {
    return {{.kind = GroundChange::Kind::kAssign, .function = function, .sum = sum}};
  }
  if (!sum.functions.empty() || sum.constant.low != sum.constant.high) {
    terms_.Fail(literal.place, "not a bound", "f(...) <, <=, > or >= and a number");
  }
  return {{.kind = GroundChange::Kind::kNarrow,
           .function = function,
           .bound = terms_.BoundOf(literal, bindings)}};
}

std::vector<GroundChange> EffectGrounding::WhetherChanges(const std::vector<Literal>& literals,
                                                          bool is_addition,
                                                          const Bindings& bindings) {
  const auto formula = queries_.FormulaOf(literals, bindings);
  if (!formula) return {};
  return {{.kind = is_addition ? GroundChange::Kind::kSense : GroundChange::Kind::kUnsense,
           .formula = *formula}};
}

// Parameters may make two alternatives equal. Equal alternatives count as one.
std::vector<GroundChange> EffectGrounding::RelationChanges(const Change& change,
                                                           const Bindings& bindings) {
  GroundChange relation;
  relation.kind = GroundChange::Kind::kRelate;
  relation.is_inclusive = change.is_inclusive;
  for (const Literal& literal : change.literals) {
    AtomId atom;
    if (literal.relation == Relation::kPredicate) {
      atom = terms_.table().Atom(literal.predicate, terms_.Constants(literal.arguments, bindings));
    } else if (const auto equality = terms_.EqualityOf(literal, bindings)) {
      atom = terms_.table().Value(equality->first, equality->second);
    }
    if (atom.IsNone() && !bindings.empty()) terms_.Refuse();  // the function has no such value
    if (terms_.is_refused()) return {};
    if (atom.IsNone()) terms_.Fail(literal.place, "no value of this function", "one of its type");
    const GroundLiteral alternative{atom, literal.is_positive};
    const bool is_new =
        std::ranges::find(relation.literals, alternative) == relation.literals.end();
    if (is_new) relation.literals.push_back(alternative);
  }
  return {relation};
}

// Returns, for each instance of the LCW formula, the change by which an action learns whether the
// instance is true.
std::vector<GroundChange> EffectGrounding::ClosedChanges(const Change& change, Bindings bindings) {
  std::vector<GroundChange> changes;
  terms_.ForEachBinding(change.variables, bindings, 0, [&] {
    for (GroundChange& ground : WhetherChanges(change.literals, change.is_addition, bindings)) {
      changes.push_back(std::move(ground));
    }
  });
  return changes;
}

}  // namespace assay::contingent
