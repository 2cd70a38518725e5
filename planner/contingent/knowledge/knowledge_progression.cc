#include "planner/contingent/knowledge/knowledge_progression.h"

#include <algorithm>
#include <list>
#include <utility>

namespace assay::contingent {
namespace {

// Returns true if the change only senses something or only asserts a relation or a bound. It does
// not change the world, and it happens only if its condition is known.
bool TellsSomething(const GroundChange& change) {
  using Kind = GroundChange::Kind;
  return change.kind == Kind::kSense || change.kind == Kind::kSenseValue ||
         change.kind == Kind::kRelate || change.kind == Kind::kNarrow;
}

void AddNumbers(const GroundQuery& query, std::set<FunctionId>& numbers) {
  if (query.kind == GroundQuery::Kind::kBoundKnown) numbers.insert(query.bound.function);
  for (const GroundQuery& operand : query.operands) AddNumbers(operand, numbers);
}

// Returns the place of the change in the order of application. Becoming true wins over becoming
// false, as in PDDL. Asserted and sensed facts describe the world after all changes.
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
      return 5;  // a relation comes last because it can fail
  }
  return 0;
}

}  // namespace

std::optional<KnowledgeState> KnowledgeProgression::After(const std::vector<GroundEffect>& effects,
                                                          const KnowledgeState& before) {
  return After(ChangesOf(effects, before), before);
}

std::optional<KnowledgeState> KnowledgeProgression::AfterCertain(const GroundEffect& effect,
                                                                 const KnowledgeState& before) {
  Changes changes{.bounds = OpenBounds(task_, before, atoms_.worlds())};
  for (const GroundChange& change : effect.changes) changes.certain.push_back(&change);
  return After(changes, before);
}

// ---- Collecting the changes

KnowledgeProgression::Changes KnowledgeProgression::ChangesOf(
    const std::vector<GroundEffect>& effects, const KnowledgeState& state) {
  Changes changes{.bounds = OpenBounds(task_, state, atoms_.worlds())};
  for (const GroundEffect& effect : effects) {
    if (queries_.Holds(effect.condition, state)) {
      for (const GroundChange& change : effect.changes) changes.certain.push_back(&change);
    } else if (effect.is_of_worlds) {
      AddOfWorlds(effect, state, changes);
    } else {
      changes.are_decided &= !queries_.MayHold(effect.condition, state);
    }
  }
  JoinWithPossible(changes);
  return changes;
}

void KnowledgeProgression::AddOfWorlds(const GroundEffect& effect, const KnowledgeState& state,
                                       Changes& changes) {
  WorldSets& worlds = atoms_.worlds();
  const Diagram where = atoms_.Restricted(worlds.Where(effect.condition, changes.bounds), state);
  const Diagram possible =
      worlds.And(atoms_.RelationsWith(state, where), changes.bounds.Together());
  if (worlds.And(possible, where) == kEmptySet) return;
  const bool is_certain = worlds.Implies(possible, where);
  for (const GroundChange& change : effect.changes) {
    if (TellsSomething(change)) {
      changes.are_decided &= !queries_.MayHold(effect.condition, state);
    } else if (is_certain) {
      changes.certain.push_back(&change);
    } else {
      AddPossible(change, where, changes);
      AddNumbers(effect.condition, changes.deciding);
    }
  }
}

void KnowledgeProgression::AddPossible(const GroundChange& change, Diagram where,
                                       Changes& changes) {
  WorldSets& worlds = atoms_.worlds();
  switch (change.kind) {
    case GroundChange::Kind::kSet: {
      PossibleChange& possible = changes.possible[change.literal.atom];
      Diagram& becomes =
          change.literal.is_positive ? possible.becomes_true : possible.becomes_false;
      becomes = worlds.Or(becomes, where);
      return;
    }
    case GroundChange::Kind::kForget: {
      Diagram& becomes_open = changes.possible[change.literal.atom].becomes_open;
      becomes_open = worlds.Or(becomes_open, where);
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
      return;  // nothing is sensed or asserted under a condition that is not known
  }
}

// A change that certainly makes an atom false or open holds only where no possible change gives the
// atom another value, and where no other value of its function becomes true.
void KnowledgeProgression::JoinWithPossible(Changes& changes) const {
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
    PossibleChange& possible = changes.possible[atom];
    (!is_set       ? possible.becomes_open
     : is_positive ? possible.becomes_true
                   : possible.becomes_false) = kAllSets;
    return true;
  });
}

bool KnowledgeProgression::MayGiveTwoValues(const Changes& changes, const KnowledgeState& before) {
  WorldSets& worlds = atoms_.worlds();
  std::vector<ChangeSomewhere> given = changes.unsettled;
  std::list<GroundChange> set;
  for (const auto& [atom, where] : changes.possible) {
    if (task_.function_of_atom[atom.index()].IsNone()) continue;
    given.emplace_back(&set.emplace_back(GroundChange{.literal = {atom, true}}),
                       where.becomes_true);
  }
  for (const GroundChange* change : changes.certain) given.emplace_back(change, kAllSets);
  const Diagram both = WhereTwoValues(task_, std::move(given), worlds);
  if (both == kEmptySet) return false;
  const Diagram possible =
      worlds.And(atoms_.RelationsWith(before, both), changes.bounds.Together());
  return worlds.And(possible, both) != kEmptySet;
}

// ---- Applying the changes

std::optional<KnowledgeState> KnowledgeProgression::After(const Changes& changes,
                                                          const KnowledgeState& before) {
  const auto doubted = [&] {
    has_doubted_ = true;
    return std::nullopt;
  };
  if (!changes.are_decided) return doubted();
  if (MayGiveTwoValues(changes, before)) return std::nullopt;
  KnowledgeState state = before;
  if (!changes.possible.empty()) atoms_.Change(state, changes.possible, changes.bounds);
  for (const int now : {0, 1, 2, 3, 4}) {
    for (const GroundChange* change : changes.certain) {
      if (RankOf(*change) == now) Apply(*change, before, state);
    }
    if (now != RankOf({.kind = GroundChange::Kind::kAssign})) continue;
    ApplyUnsettled(changes, before, state);
    if (!CanTellBounds(changes, state)) return doubted();
  }
  for (const GroundChange* change : changes.certain) {
    if (!Relate(*change, state)) return std::nullopt;
  }
  return state;
}

void KnowledgeProgression::Apply(const GroundChange& change, const KnowledgeState& before,
                                 KnowledgeState& state) {
  switch (change.kind) {
    case GroundChange::Kind::kSet:
      return atoms_.Set(state, change.literal);
    case GroundChange::Kind::kForget:
      return atoms_.Forget(state, change.literal.atom);
    case GroundChange::Kind::kSense:
      return layout_.SetSensed(state, change.formula, true);
    case GroundChange::Kind::kUnsense:
      return layout_.SetSensed(state, change.formula, false);
    case GroundChange::Kind::kSenseValue:
      return numbers_.Sense(state, change.function, change.error);
    case GroundChange::Kind::kUnsenseValue:
      return layout_.SetSensed(state, change.function, false);
    case GroundChange::Kind::kRelate:
      return;
    case GroundChange::Kind::kAssign:
      return numbers_.Assign(change, before, state);
    case GroundChange::Kind::kNarrow:
      return numbers_.Learn(state, change.bound);
    case GroundChange::Kind::kForgetNumber:
      return numbers_.Forget(state, change.function);
  }
}

void KnowledgeProgression::ApplyUnsettled(const Changes& changes, const KnowledgeState& before,
                                          KnowledgeState& state) {
  for (const auto& [change, where] : changes.unsettled) {
    const Range otherwise = numbers_.RangeOf(change->function, state);
    Apply(*change, before, state);
    numbers_.Unsettle(state, change->function, otherwise);
    atoms_.Entangle(state, where);
  }
  for (const FunctionId function : changes.deciding) numbers_.Entangle(state, function);
}

bool KnowledgeProgression::CanTellBounds(const Changes& changes,
                                         const KnowledgeState& state) const {
  return std::ranges::all_of(changes.certain, [&](const GroundChange* change) {
    return change->kind != GroundChange::Kind::kNarrow || numbers_.Holds(change->bound, state) ||
           !numbers_.RangeOf(change->bound.function, state).is_outer;
  });
}

bool KnowledgeProgression::Relate(const GroundChange& change, KnowledgeState& state) {
  if (change.kind == GroundChange::Kind::kNarrow) {
    return numbers_.CanBe(change.bound.function, state);
  }
  return change.kind != GroundChange::Kind::kRelate ||
         atoms_.Relate(state, change.literals, change.is_inclusive);
}

}  // namespace assay::contingent
