#include "planner/contingent/knowledge_base.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "planner/algebra/interval_arithmetic.h"
#include "planner/base/check.h"
#include "planner/contingent/variable_order.h"

namespace assay::contingent {
namespace {

bool IsSingle(const Range& range) { return range.low == range.high; }

Range Hull(const Range& a, const Range& b) {
  Range hull = a.low <= b.low ? a : b;
  if (a.low == b.low) hull.excludes_low = a.excludes_low && b.excludes_low;
  const Range& higher = a.high >= b.high ? a : b;
  hull.high = higher.high;
  hull.excludes_high = higher.excludes_high;
  if (a.high == b.high) hull.excludes_high = a.excludes_high && b.excludes_high;
  return hull;
}

bool CanHold(const Range& range) {
  return range.low < range.high ||
         (range.low == range.high && !range.excludes_low && !range.excludes_high);
}

// Then it is no change of the world, and happens only if its condition is known.
bool TellsSomething(const GroundChange& change) {
  using Kind = GroundChange::Kind;
  return change.kind == Kind::kSense || change.kind == Kind::kSenseValue ||
         change.kind == Kind::kRelate || change.kind == Kind::kNarrow;
}

void AddNumbers(const GroundQuery& query, std::set<FunctionId>& numbers) {
  if (query.kind == GroundQuery::Kind::kBoundKnown) numbers.insert(query.bound.function);
  for (const GroundQuery& operand : query.operands) AddNumbers(operand, numbers);
}

// What becomes true wins over what becomes false, as in PDDL; what is told and what is sensed is so
// after all that.
int RankOf(const GroundChange& change) {
  switch (change.kind) {
    case GroundChange::Kind::kForget:
      return 0;
    case GroundChange::Kind::kSet:
      return change.literal.is_positive ? 2 : 1;
    case GroundChange::Kind::kUnsense:
    case GroundChange::Kind::kUnsenseValue:
    case GroundChange::Kind::kAssign:
    case GroundChange::Kind::kForgetNumber:
      return 3;
    case GroundChange::Kind::kNarrow:
    case GroundChange::Kind::kSense:
    case GroundChange::Kind::kSenseValue:
      return 4;
    case GroundChange::Kind::kRelate:
      return 5;  // and can fail
  }
  return 0;
}

}  // namespace

KnowledgeBase::KnowledgeBase(const GroundTask& task)
    : task_(task),
      layout_(task),
      places_(PlacesOfAtoms(task)),
      atom_at_(task.atoms.size()),
      formulas_of_atom_(task.atoms.size()) {
  for (std::size_t i = 0; i < places_.size(); ++i) atom_at_[places_[i]] = AtomId(i);
  for (std::size_t f = 0; f < task.formulas.size(); ++f) {
    for (const GroundLiteral& literal : task.formulas[f].literals) {
      formulas_of_atom_[literal.atom.index()].push_back(FormulaId(f));
    }
  }
}

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
  for (const auto& [f, error] : task_.initial.values_sensed) SenseValue(state, f, error);
  // Nothing has been done yet: what rules tell now is of the same moment as init.
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
    return !Relate(state, relation.literals, relation.is_inclusive);
  });
  return wrong == relations.end() ? nullptr : &*wrong;
}

// ---- Queries

bool KnowledgeBase::Holds(const GroundQuery& query, const KnowledgeState& state) const {
  const auto holds = [&](const GroundQuery& operand) { return Holds(operand, state); };
  switch (query.kind) {
    case GroundQuery::Kind::kAnd:
      return std::all_of(query.operands.begin(), query.operands.end(), holds);
    case GroundQuery::Kind::kOr:
      return std::any_of(query.operands.begin(), query.operands.end(), holds);
    case GroundQuery::Kind::kNot:
      return !MayHold(query.operands.front(), state);
    case GroundQuery::Kind::kKnown:
      return layout_.IsKnown(state, query.literal);
    case GroundQuery::Kind::kBoundKnown:
      return BoundHolds(query.bound, state);
    case GroundQuery::Kind::kSensed:
      return layout_.IsSensed(state, query.formula);
    case GroundQuery::Kind::kValueSensed:
      return IsValueKnown(query, state);
  }
  return false;
}

bool KnowledgeBase::MayHold(const GroundQuery& query, const KnowledgeState& state) const {
  const auto may_hold = [&](const GroundQuery& operand) { return MayHold(operand, state); };
  switch (query.kind) {
    case GroundQuery::Kind::kAnd:
      return std::all_of(query.operands.begin(), query.operands.end(), may_hold);
    case GroundQuery::Kind::kOr:
      return std::any_of(query.operands.begin(), query.operands.end(), may_hold);
    case GroundQuery::Kind::kNot:
      return !Holds(query.operands.front(), state);
    case GroundQuery::Kind::kKnown:
    case GroundQuery::Kind::kSensed:
      return Holds(query, state);
    case GroundQuery::Kind::kBoundKnown:
      return BoundHolds(query.bound, state) || (RangeOf(query.bound.function, state).is_outer &&
                                                !BoundHolds(Negation(query.bound), state));
    case GroundQuery::Kind::kValueSensed: {
      const bool is_number = task_.functions[query.function.index()].slot >= 0;
      return IsValueKnown(query, state) || (is_number && RangeOf(query.function, state).is_outer);
    }
  }
  return false;
}

bool KnowledgeBase::IsValueKnown(const GroundQuery& query, const KnowledgeState& state) const {
  const bool is_sensed = layout_.IsSensed(state, query.function);
  if (task_.functions[query.function.index()].slot < 0) return is_sensed;
  const Range& range = RangeOf(query.function, state);
  return range.high - range.low <= 2 * query.within.value_or(0) ||
         (is_sensed && (!query.within || range.error <= *query.within));
}

bool KnowledgeBase::BoundHolds(const Bound& bound, const KnowledgeState& state) const {
  return SurelyHolds(bound, RangeOf(bound.function, state));
}

bool KnowledgeBase::IsDetermined(const Formula& formula, const KnowledgeState& state) const {
  if (formula.bound) {
    return BoundHolds(*formula.bound, state) || BoundHolds(Negation(*formula.bound), state);
  }
  bool are_all_true = true;
  for (const GroundLiteral& literal : formula.literals) {
    if (layout_.IsKnown(state, {literal.atom, !literal.is_positive})) return true;
    are_all_true &= layout_.IsKnown(state, literal);
  }
  return are_all_true;
}

Diagram KnowledgeBase::WorldsWhere(const GroundQuery& condition, OpenBounds& bounds) {
  if (condition.kind == GroundQuery::Kind::kKnown) return WorldsWhere(condition.literal);
  if (condition.kind == GroundQuery::Kind::kBoundKnown) return bounds.WorldsWhere(condition.bound);
  const bool is_and = condition.kind == GroundQuery::Kind::kAnd;
  Diagram worlds = is_and ? kAllSets : kEmptySet;
  for (const GroundQuery& operand : condition.operands) {
    const Diagram of_operand = WorldsWhere(operand, bounds);
    worlds = is_and ? diagrams_.And(worlds, of_operand) : diagrams_.Or(worlds, of_operand);
  }
  return worlds;
}

Diagram KnowledgeBase::Restricted(Diagram worlds, const KnowledgeState& state) {
  std::vector<Assignment> known;
  for (const int variable : diagrams_.Support(worlds)) {
    if (!IsOfAtom(variable)) continue;
    for (const bool value : {true, false}) {
      if (layout_.IsKnown(state, {AtomOf(variable), value})) known.push_back({variable, value});
    }
  }
  return diagrams_.Restrict(worlds, known);
}

Diagram KnowledgeBase::RelationsWith(const KnowledgeState& state, Diagram of) {
  KnowledgeState rest = state;
  return TakeRelations(rest, diagrams_.Support(of));
}

bool KnowledgeBase::IsWithin(const KnowledgeState& state, Diagram worlds) {
  // Most sets are decided by what is known, without looking at more of them.
  while (!diagrams_.IsConstant(worlds)) {
    const AtomId atom = AtomOf(diagrams_.variable(worlds));
    if (layout_.IsKnown(state, {atom, true})) {
      worlds = diagrams_.high(worlds);
    } else if (layout_.IsKnown(state, {atom, false})) {
      worlds = diagrams_.low(worlds);
    } else {
      break;
    }
  }
  const Diagram restricted = Restricted(worlds, state);
  if (diagrams_.IsConstant(restricted)) return restricted == kAllSets;
  return diagrams_.Implies(RelationsWith(state, restricted), restricted);
}

Diagram KnowledgeBase::RelationOf(const KnowledgeState& state, AtomId atom) {
  for (const Diagram relation : state.relations) {
    const std::vector<int>& support = diagrams_.Support(relation);
    if (std::binary_search(support.begin(), support.end(), Variable(atom))) return relation;
  }
  return kAllSets;
}

// ---- Actions

std::optional<KnowledgeState> KnowledgeBase::After(const GroundAction& action,
                                                   const KnowledgeState& state) {
  KnowledgeState next = state;
  if (!Apply(ChangesOf(action.effects, state), state, next)) return std::nullopt;
  return Settled(std::move(next));
}

KnowledgeBase::Changes KnowledgeBase::ChangesOf(const std::vector<GroundEffect>& effects,
                                                const KnowledgeState& state) {
  Changes changes{.bounds = OpenBounds(task_, state, diagrams_)};
  for (const GroundEffect& effect : effects) {
    if (Holds(effect.condition, state)) {
      for (const GroundChange& change : effect.changes) changes.certain.push_back(&change);
    } else if (effect.is_of_worlds) {
      AddOfWorlds(effect, state, changes);
    } else {
      changes.are_told &= !MayHold(effect.condition, state);
    }
  }
  JoinWithPossible(changes);
  return changes;
}

// What surely becomes false, or open, stays so only where nothing makes it something else, and
// where no other value of its function becomes true.
void KnowledgeBase::JoinWithPossible(Changes& changes) const {
  std::set<FunctionId> functions;
  for (const auto& [atom, where] : changes.possible) {
    functions.insert(task_.function_of_atom[atom.index()]);
  }
  functions.erase(FunctionId::None());
  std::erase_if(changes.certain, [&](const GroundChange* change) {
    const bool is_set = change->kind == GroundChange::Kind::kSet;
    if (!is_set && change->kind != GroundChange::Kind::kForget) return false;
    const auto& [atom, is_positive] = change->literal;
    const bool is_value = functions.contains(task_.function_of_atom[atom.index()]);
    if (!is_value && ((is_set && is_positive) || !changes.possible.contains(atom))) return false;
    Possible& possible = changes.possible[atom];
    (!is_set       ? possible.becomes_open
     : is_positive ? possible.becomes_true
                   : possible.becomes_false) = kAllSets;
    return true;
  });
}

void KnowledgeBase::AddOfWorlds(const GroundEffect& effect, const KnowledgeState& state,
                                Changes& changes) {
  const Diagram where = Restricted(WorldsWhere(effect.condition, changes.bounds), state);
  const Diagram possible = diagrams_.And(RelationsWith(state, where), changes.bounds.Together());
  if (diagrams_.And(possible, where) == kEmptySet) return;
  const bool is_certain = diagrams_.Implies(possible, where);
  for (const GroundChange& change : effect.changes) {
    if (TellsSomething(change)) {
      changes.are_told &= !MayHold(effect.condition, state);
    } else if (is_certain) {
      changes.certain.push_back(&change);
    } else {
      AddPossible(change, where, changes);
      AddNumbers(effect.condition, changes.deciding);
    }
  }
}

void KnowledgeBase::AddPossible(const GroundChange& change, Diagram where, Changes& changes) {
  switch (change.kind) {
    case GroundChange::Kind::kSet: {
      Possible& possible = changes.possible[change.literal.atom];
      Diagram& becomes =
          change.literal.is_positive ? possible.becomes_true : possible.becomes_false;
      becomes = diagrams_.Or(becomes, where);
      return;
    }
    case GroundChange::Kind::kForget: {
      Diagram& becomes_open = changes.possible[change.literal.atom].becomes_open;
      becomes_open = diagrams_.Or(becomes_open, where);
      return;
    }
    case GroundChange::Kind::kUnsense:
    case GroundChange::Kind::kUnsenseValue:
      changes.certain.push_back(&change);
      return;
    case GroundChange::Kind::kForgetNumber:
    case GroundChange::Kind::kAssign:
      changes.unsettled.emplace_back(&change, where);
      return;
    case GroundChange::Kind::kSense:
    case GroundChange::Kind::kSenseValue:
    case GroundChange::Kind::kRelate:
    case GroundChange::Kind::kNarrow:
      return;  // nothing is sensed or told under a condition that is not known
  }
}

bool KnowledgeBase::MayGiveTwoValues(const Changes& changes, const KnowledgeState& before) {
  std::vector<std::pair<GroundChange, Diagram>> given;
  for (const auto& [atom, where] : changes.possible) {
    given.push_back({{.literal = {atom, true}}, where.becomes_true});
  }
  for (const GroundChange* change : changes.certain) given.emplace_back(*change, kAllSets);
  for (const auto& [change, where] : changes.unsettled) given.emplace_back(*change, where);
  std::erase_if(given, [&](const auto& gift) {
    return FunctionGiven(task_, gift.first).IsNone() || gift.second == kEmptySet;
  });
  for (std::size_t i = 0; i < given.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!GiveTwoValues(task_, given[i].first, given[j].first)) continue;
      const Diagram both = diagrams_.And(given[i].second, given[j].second);
      const Diagram possible =
          diagrams_.And(RelationsWith(before, both), changes.bounds.Together());
      if (diagrams_.And(possible, both) != kEmptySet) return true;
    }
  }
  return false;
}

bool KnowledgeBase::Apply(const Changes& changes, const KnowledgeState& before,
                          KnowledgeState& state) {
  if (!changes.are_told || MayGiveTwoValues(changes, before)) return false;
  if (!changes.possible.empty()) ApplyPossible(changes, state);
  for (const int now : {0, 1, 2, 3, 4}) {
    for (const GroundChange* change : changes.certain) {
      if (RankOf(*change) == now) Apply(*change, before, state);
    }
    if (now != RankOf({.kind = GroundChange::Kind::kAssign})) continue;
    for (const auto& [change, where] : changes.unsettled) Unsettle(*change, before, state);
    for (const FunctionId function : changes.deciding) RangeOf(function, state).is_outer = true;
    if (!CanTellBounds(changes, state)) return false;
  }
  return std::all_of(changes.certain.begin(), changes.certain.end(), [&](const GroundChange* c) {
    if (c->kind == GroundChange::Kind::kNarrow) return CanHold(RangeOf(c->bound.function, state));
    return c->kind != GroundChange::Kind::kRelate || Relate(state, c->literals, c->is_inclusive);
  });
}

bool KnowledgeBase::CanTellBounds(const Changes& changes, const KnowledgeState& state) const {
  return std::ranges::all_of(changes.certain, [&](const GroundChange* change) {
    return change->kind != GroundChange::Kind::kNarrow || BoundHolds(change->bound, state) ||
           !RangeOf(change->bound.function, state).is_outer;
  });
}

void KnowledgeBase::Apply(const GroundChange& change, const KnowledgeState& before,
                          KnowledgeState& state) {
  switch (change.kind) {
    case GroundChange::Kind::kSet:
      return Set(state, change.literal);
    case GroundChange::Kind::kForget:
      return Forget(state, change.literal.atom);
    case GroundChange::Kind::kSense:
      return layout_.SetSensed(state, change.formula, true);
    case GroundChange::Kind::kUnsense:
      return layout_.SetSensed(state, change.formula, false);
    case GroundChange::Kind::kSenseValue:
      return SenseValue(state, change.function, change.error);
    case GroundChange::Kind::kUnsenseValue:
      return layout_.SetSensed(state, change.function, false);
    case GroundChange::Kind::kRelate:
      return;
    case GroundChange::Kind::kAssign:
      return Assign(change, before, state);
    case GroundChange::Kind::kNarrow:
      return Learn(state, change.bound);
    case GroundChange::Kind::kForgetNumber:
      return ForgetNumber(state, change.function);
  }
}

void KnowledgeBase::SenseValue(KnowledgeState& state, FunctionId function, double error) const {
  const int slot = task_.functions[function.index()].slot;
  if (slot >= 0) {
    double& known = state.ranges[slot].error;
    known = layout_.IsSensed(state, function) ? std::min(known, error) : error;
  }
  layout_.SetSensed(state, function, true);
}

Range KnowledgeBase::SumOf(const GroundSum& sum, const KnowledgeState& state) const {
  Interval total = sum.constant;
  Range result;
  for (const auto& [function, sign] : sum.functions) {
    const Range& range = RangeOf(function, state);
    const Interval interval{range.low, range.high};
    total = algebra::operator+(total, sign > 0 ? interval : algebra::operator-(interval));
    result.excludes_low |= sign > 0 ? range.excludes_low : range.excludes_high;
    result.excludes_high |= sign > 0 ? range.excludes_high : range.excludes_low;
    result.is_outer |= range.is_outer;
  }
  result.low = total.low;
  result.high = total.high;
  return result;
}

// The image of the relations under "x becomes true where A, else false where D, else either where
// O": the new x, for the time being a variable of its own, is A | (x & !D) where it is not open;
// then the old x is no matter any more. The relations come first: they keep the diagrams small.
void KnowledgeBase::ApplyPossible(const Changes& all, KnowledgeState& state) {
  std::vector<int> variables;
  std::vector<Diagram> changes;
  for (const auto& [atom, where] : all.possible) {
    const Diagram old = Restricted(WorldsWhere({atom, true}), state);
    const Diagram now =
        diagrams_.Or(where.becomes_true, diagrams_.And(old, diagrams_.Not(where.becomes_false)));
    const Diagram is_open = diagrams_.And(
        where.becomes_open, diagrams_.Not(diagrams_.Or(where.becomes_true, where.becomes_false)));
    changes.push_back(
        diagrams_.Or(is_open, diagrams_.Equal(diagrams_.Literal({Variable(atom) + 1, true}), now)));
    const std::vector<int>& of_change = diagrams_.Support(changes.back());
    variables.insert(variables.end(), of_change.begin(), of_change.end());
    variables.push_back(Variable(atom));
    UnsenseWith(state, atom);
  }
  Diagram image = diagrams_.And(TakeRelations(state, variables), all.bounds.Together());
  for (const Diagram change : changes) image = diagrams_.And(image, change);
  for (const int bound : all.bounds.Variables()) image = diagrams_.Exists(image, bound);
  std::unordered_map<int, Diagram> renamed;
  for (const auto& [atom, where] : all.possible) {
    image = diagrams_.Exists(image, Variable(atom));
    renamed[Variable(atom) + 1] = WorldsWhere({atom, true});
    layout_.SetUnknown(state, atom);
  }
  // What is open is so as values of one function are.
  image = diagrams_.Compose(image, renamed);
  image = diagrams_.And(image, UniqueNames(diagrams_.Support(image), state));
  const bool can_hold = PutRelation(state, image);
  ASSAY_CHECK(can_hold, "an effect left no world");
}

const GroundEffect* KnowledgeBase::ApplyUpdates(KnowledgeState& state,
                                                const std::vector<InitialRelation>& lasting) {
  // A rule that undoes another's change within a round is not at rest either, though the round ends
  // as it began.
  bool is_at_rest = task_.updates.empty();
  const auto contradicts_lasting = [&](KnowledgeState copy) {
    return RelateAll(copy, lasting) != nullptr;
  };
  for (std::size_t round = 0; !is_at_rest; ++round) {
    is_at_rest = true;
    for (const GroundEffect& update : task_.updates) {
      if (!MayHold(update.condition, state)) continue;
      if (!Holds(update.condition, state)) return &update;
      const KnowledgeState before = state;
      Changes changes{.bounds = OpenBounds(task_, before, diagrams_)};
      for (const GroundChange& change : update.changes) changes.certain.push_back(&change);
      if (!Apply(changes, before, state)) return &update;
      if (!lasting.empty() && contradicts_lasting(state)) return &update;
      Canonicalize(state);
      if (state == before) continue;
      is_at_rest = false;
      if (round == MostRoundsOf(task_)) FailRestless(update, round);
    }
  }
  return nullptr;
}

void KnowledgeBase::FailRestless(const GroundEffect& update, std::size_t rounds) const {
  throw InputError(
      {task_.domain_file, update.place.line, update.place.column},
      fmt::format("update rules do not come to rest: this one changes what is known after {} "
                  "rounds of all of them",
                  rounds),
      "rules that do not undo what others do");
}

void KnowledgeBase::Canonicalize(KnowledgeState& state) const {
  std::sort(state.relations.begin(), state.relations.end());
  for (std::size_t f = 0; f < task_.formulas.size(); ++f) {
    const FormulaId formula(f);
    if (layout_.IsSensed(state, formula) && IsDetermined(task_.formulas[f], state)) {
      layout_.SetSensed(state, formula, false);
    }
  }
  for (std::size_t f = 0; f < task_.functions.size(); ++f) {
    const FunctionId function(f);
    if (!layout_.IsSensed(state, function)) continue;
    const std::vector<AtomId>& values = task_.functions[f].values;
    const bool is_known = std::any_of(values.begin(), values.end(), [&](AtomId value) {
      return layout_.IsKnown(state, {value, true});
    });
    if (is_known) layout_.SetSensed(state, function, false);
  }
}

// ---- Changes of Kf and Kx

void KnowledgeBase::UnsenseWith(KnowledgeState& state, AtomId atom) {
  for (const FormulaId formula : formulas_of_atom_[atom.index()]) {
    layout_.SetSensed(state, formula, false);
  }
  const FunctionId function = task_.function_of_atom[atom.index()];
  if (!function.IsNone()) layout_.SetSensed(state, function, false);
}

void KnowledgeBase::Unrelate(KnowledgeState& state, AtomId atom) {
  const Diagram relation = RelationOf(state, atom);
  if (relation == kAllSets) return;
  std::erase(state.relations, relation);
  PutRelation(state, diagrams_.Exists(relation, Variable(atom)));
}

void KnowledgeBase::Set(KnowledgeState& state, GroundLiteral literal) {
  UnsenseWith(state, literal.atom);
  if (layout_.IsUndetermined(state, literal.atom)) Unrelate(state, literal.atom);
  layout_.SetKnown(state, literal);
}

void KnowledgeBase::Forget(KnowledgeState& state, AtomId atom) {
  UnsenseWith(state, atom);
  if (layout_.IsUndetermined(state, atom)) Unrelate(state, atom);
  layout_.SetUnknown(state, atom);
}

void KnowledgeBase::ForgetNumber(KnowledgeState& state, FunctionId function) const {
  layout_.SetSensed(state, function, false);
  RangeOf(function, state) = {.low = -algebra::kInfinity, .high = algebra::kInfinity};
}

void KnowledgeBase::Assign(const GroundChange& change, const KnowledgeState& before,
                           KnowledgeState& state) const {
  layout_.SetSensed(state, change.function, false);
  Range& range = RangeOf(change.function, state);
  range = SumOf(change.sum, before);
  // What is learned later of one number of a sum tells something of the others.
  for (const auto& [function, sign] : change.sum.functions) {
    const bool is_alone = function == change.function && change.sum.functions.size() == 1;
    if (is_alone || IsSingle(RangeOf(function, before))) continue;
    RangeOf(function, state).is_outer = true;
    range.is_outer = true;
  }
}

void KnowledgeBase::Unsettle(const GroundChange& change, const KnowledgeState& before,
                             KnowledgeState& state) {
  const Range otherwise = RangeOf(change.function, state);
  Apply(change, before, state);
  Range& range = RangeOf(change.function, state);
  range = Hull(range, otherwise);
  range.is_outer = true;
}

bool KnowledgeBase::Relate(KnowledgeState& state, const std::vector<GroundLiteral>& literals,
                           bool is_inclusive) {
  const Diagram relation = Restricted(WorldsWhere(literals, is_inclusive), state);
  return RelateAsWell(state, relation);
}

bool KnowledgeBase::RelateAsWell(KnowledgeState& state, Diagram relation) {
  const std::vector<int>& variables = diagrams_.Support(relation);
  return PutRelation(state, diagrams_.And(relation, TakeRelations(state, variables)));
}

Diagram KnowledgeBase::WorldsWhere(const std::vector<GroundLiteral>& literals, bool is_inclusive) {
  std::vector<Assignment> assignments;
  assignments.reserve(literals.size());
  for (const GroundLiteral& l : literals) {
    assignments.push_back({Variable(l.atom), l.is_positive});
  }
  return is_inclusive ? diagrams_.AtLeastOne(assignments) : diagrams_.ExactlyOne(assignments);
}

Diagram KnowledgeBase::TakeRelations(KnowledgeState& state, std::vector<int> wanted) {
  Diagram all = kAllSets;
  std::set<FunctionId> functions;
  std::vector<int> fresh = std::move(wanted);
  while (!fresh.empty()) {
    std::vector<int> next;
    for (std::size_t i = 0, count = fresh.size(); i < count; ++i) {
      const FunctionId function = FunctionOf(fresh[i]);
      if (function.IsNone() || !functions.insert(function).second) continue;
      const std::vector<int> values = OpenValues(function, state);
      all = diagrams_.And(all, UniqueNames(values, state));
      fresh.insert(fresh.end(), values.begin(), values.end());
    }
    std::erase_if(state.relations, [&](Diagram relation) {
      const std::vector<int>& support = diagrams_.Support(relation);
      const bool shares = std::any_of(fresh.begin(), fresh.end(), [&](int variable) {
        return std::binary_search(support.begin(), support.end(), variable);
      });
      if (!shares) return false;
      all = diagrams_.And(all, relation);
      next.insert(next.end(), support.begin(), support.end());
      return true;
    });
    std::erase_if(next, [&](int variable) {
      const FunctionId function = FunctionOf(variable);
      return function.IsNone() || functions.contains(function);
    });
    fresh = std::move(next);
  }
  return all;
}

FunctionId KnowledgeBase::FunctionOf(int variable) const {
  return IsOfAtom(variable) ? task_.function_of_atom[AtomOf(variable).index()] : FunctionId::None();
}

std::vector<int> KnowledgeBase::OpenValues(FunctionId function, const KnowledgeState& state) const {
  std::vector<int> open;
  for (const AtomId value : task_.functions[function.index()].values) {
    if (layout_.IsUndetermined(state, value)) open.push_back(Variable(value));
  }
  return open;
}

Diagram KnowledgeBase::UniqueNames(const std::vector<int>& variables, const KnowledgeState& state) {
  std::map<FunctionId, std::vector<Assignment>> values;
  for (const int variable : variables) {
    const FunctionId function = FunctionOf(variable);
    if (function.IsNone() || !layout_.IsUndetermined(state, AtomOf(variable))) continue;
    values[function].push_back({variable, true});
  }
  Diagram unique = kAllSets;
  for (const auto& [function, open] : values) {
    if (open.size() == 1) continue;
    const Diagram is_none = diagrams_.Not(diagrams_.AtLeastOne(open));
    unique = diagrams_.And(unique, diagrams_.Or(is_none, diagrams_.ExactlyOne(open)));
  }
  return unique;
}

bool KnowledgeBase::PutRelation(KnowledgeState& state, Diagram relation) {
  if (relation == kEmptySet) return false;
  const std::vector<Assignment> known = diagrams_.Essential(relation);
  relation = diagrams_.Restrict(relation, known);
  // Unique names hold without being said.
  if (relation != UniqueNames(diagrams_.Support(relation), state)) {
    state.relations.insert(
        std::lower_bound(state.relations.begin(), state.relations.end(), relation), relation);
  }
  for (const Assignment& a : known) Learn(state, {AtomOf(a.variable), a.value});
  return true;
}

void KnowledgeBase::Learn(KnowledgeState& state, GroundLiteral literal) {
  if (!layout_.IsUndetermined(state, literal.atom)) return;
  const Diagram relation = RelationOf(state, literal.atom);
  layout_.SetKnown(state, literal);
  if (relation != kAllSets) {
    std::erase(state.relations, relation);
    const bool can_hold = PutRelation(
        state, diagrams_.Cofactor(relation, {Variable(literal.atom), literal.is_positive}));
    ASSAY_CHECK(can_hold, "learned what cannot be: {}", TextOf(task_, literal));
  }
  // A function has one value (unique names).
  const FunctionId function = task_.function_of_atom[literal.atom.index()];
  if (!literal.is_positive || function.IsNone()) return;
  for (const AtomId value : task_.functions[function.index()].values) {
    if (value != literal.atom) Learn(state, {value, false});
  }
}

// That not all of several hold does not say of any of them that it does not.
bool KnowledgeBase::LearnConjunction(KnowledgeState& state,
                                     const std::vector<GroundLiteral>& literals, bool value) {
  Diagram where = kAllSets;
  for (const GroundLiteral& literal : literals) {
    where = diagrams_.And(where, WorldsWhere(literal));
  }
  return RelateAsWell(state, Restricted(value ? where : diagrams_.Not(where), state));
}

void KnowledgeBase::Learn(KnowledgeState& state, const Bound& bound) const {
  Range& range = RangeOf(bound.function, state);
  range = Narrowed(range, bound);
}

// ---- Branches

GroundLiteral KnowledgeBase::UndeterminedLiteral(FormulaId formula,
                                                 const KnowledgeState& state) const {
  for (const GroundLiteral& literal : task_.formulas[formula.index()].literals) {
    if (layout_.IsUndetermined(state, literal.atom)) return literal;
  }
  return {};
}

FormulaId KnowledgeBase::FormulaToBranch(const KnowledgeState& state) const {
  for (std::size_t f = 0; f < task_.formulas.size(); ++f) {
    const FormulaId formula(f);
    if (!layout_.IsSensed(state, formula)) continue;
    const std::vector<GroundLiteral>& literals = task_.formulas[f].literals;
    const auto undetermined = std::count_if(
        literals.begin(), literals.end(),
        [&](const GroundLiteral& literal) { return layout_.IsUndetermined(state, literal.atom); });
    if (undetermined == 1 || task_.formulas[f].bound) return formula;
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
    if (!layout_.IsSensed(state, function) || task_.functions[f].slot >= 0) continue;
    std::vector<Assignment> values;
    for (const AtomId value : PossibleValues(function, state)) {
      values.push_back({Variable(value), true});
    }
    if (IsWithin(state, diagrams_.AtLeastOne(values))) functions.push_back(function);
  }
  return functions;
}

std::optional<KnowledgeState> KnowledgeBase::Learned(const KnowledgeState& state, FormulaId formula,
                                                     bool value) {
  if (const std::optional<Bound>& bound = task_.formulas[formula.index()].bound) {
    KnowledgeState next = state;
    Learn(next, value ? *bound : Negation(*bound));
    return Settled(std::move(next));
  }
  KnowledgeState next = state;
  if (!LearnConjunction(next, task_.formulas[formula.index()].literals, value)) return std::nullopt;
  return Settled(std::move(next));
}

std::optional<KnowledgeState> KnowledgeBase::Learned(const KnowledgeState& state,
                                                     GroundLiteral literal) {
  KnowledgeState next = state;
  Learn(next, literal);
  return Settled(std::move(next));
}

std::optional<KnowledgeState> KnowledgeBase::Settled(KnowledgeState state) {
  if (ApplyUpdates(state) != nullptr) return std::nullopt;
  Canonicalize(state);
  return state;
}

}  // namespace assay::contingent
