#include "planner/contingent/world_sets/world_progression.h"

#include <algorithm>
#include <ranges>
#include <set>
#include <utility>

#include "planner/contingent/language/decimal.h"
#include "planner/contingent/language/two_values.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::contingent {
namespace {

// A placeholder for a forgotten number, before it is replaced by every possible number.
constexpr Number kForgotten = {.value = kInfinity};

bool Compare(const Number& number, Relation relation, double value) {
  const Number with{value};
  switch (relation) {
    case Relation::kLess:
      return number < with;
    case Relation::kLessOrEqual:
      return number <= with;
    case Relation::kGreater:
      return number > with;
    case Relation::kGreaterOrEqual:
      return number >= with;
    case Relation::kPredicate:
    case Relation::kExtern:
    case Relation::kEqual:
      break;
  }
  return number == with;
}

Answer Least(const auto& answers) {
  Answer least = Answer::kYes;
  for (const Answer answer : answers) least = std::min(least, answer);
  return least;
}

Answer Greatest(const auto& answers) {
  Answer greatest = Answer::kNo;
  for (const Answer answer : answers) greatest = std::max(greatest, answer);
  return greatest;
}

// An action changes a world in four passes. First atoms become open, then false, then true, while
// numbers get their values. An atom that becomes both false and true is therefore true. In the last
// pass, asserted relations and bounds describe the world after these changes.
constexpr int kPasses = 4;

// Removes duplicates, which arise when different paths lead to the same sum.
void MergeEqual(Worlds& worlds) {
  std::ranges::sort(worlds);
  const auto equal = std::ranges::unique(worlds);
  worlds.erase(equal.begin(), equal.end());
}

int PassOf(const GroundChange& change) {
  if (change.kind == GroundChange::Kind::kForget) return 0;
  if (IsAsserted(change)) return 3;
  return change.kind == GroundChange::Kind::kSet && !change.literal.is_positive ? 1 : 2;
}

}  // namespace

bool WorldProgression::IsTrue(GroundLiteral literal, const World& world) {
  return world.atoms[literal.atom.index()] == (literal.is_positive ? Truth::kTrue : Truth::kFalse);
}

bool WorldProgression::IsTrue(const Bound& bound, const World& world) const {
  return Compare(world.numbers[task_.functions[bound.function.index()].slot], bound.relation,
                 bound.value);
}

bool WorldProgression::IsTrue(const Formula& formula, const World& world) const {
  if (formula.bound) return IsTrue(*formula.bound, world);
  return std::all_of(formula.literals.begin(), formula.literals.end(),
                     [&](const GroundLiteral& l) { return IsTrue(l, world); });
}

// Returns true if the formula is false for every choice of the atoms that the world leaves open.
bool WorldProgression::IsFalse(const Formula& formula, const World& world) const {
  if (formula.bound) return !IsTrue(*formula.bound, world);
  return std::ranges::any_of(formula.literals, [&](const GroundLiteral& l) {
    return IsTrue(GroundLiteral{l.atom, !l.is_positive}, world);
  });
}

// Returns true if the condition holds in this world. It must ask only K of literals and of bounds.
bool WorldProgression::IsTrue(const GroundQuery& condition, const World& world) const {
  const auto is_true = [&](const GroundQuery& operand) { return IsTrue(operand, world); };
  const auto& operands = condition.operands;
  if (condition.kind == GroundQuery::Kind::kKnown) return IsTrue(condition.literal, world);
  if (condition.kind == GroundQuery::Kind::kBoundKnown) return IsTrue(condition.bound, world);
  if (condition.kind == GroundQuery::Kind::kAnd) {
    return std::all_of(operands.begin(), operands.end(), is_true);
  }
  return std::any_of(operands.begin(), operands.end(), is_true);
}

Answer WorldProgression::Ask(const GroundQuery& query, const History& history) const {
  const auto asked = [&](const GroundQuery& operand) { return Ask(operand, history); };
  const auto answer = [](bool holds) { return holds ? Answer::kYes : Answer::kNo; };
  const auto in_all = [&](const auto& what) {
    return std::all_of(history.worlds.begin(), history.worlds.end(),
                       [&](const World& world) { return IsTrue(what, world); });
  };
  switch (query.kind) {
    case GroundQuery::Kind::kAnd:
      return Least(query.operands | std::views::transform(asked));
    case GroundQuery::Kind::kOr:
      return Greatest(query.operands | std::views::transform(asked));
    case GroundQuery::Kind::kNot:
      switch (asked(query.operands.front())) {
        case Answer::kNo:
          return Answer::kYes;
        case Answer::kCannotTell:
          return Answer::kCannotTell;
        case Answer::kYes:
          return are_sample_ ? Answer::kCannotTell : Answer::kNo;
      }
      break;
    case GroundQuery::Kind::kKnown:
      return answer(in_all(query.literal));
    case GroundQuery::Kind::kBoundKnown:
      return answer(in_all(query.bound));
    case GroundQuery::Kind::kKnownWhether:
      return answer(history.sensed.contains(query.formula) ||
                    IsDetermined(task_.formulas[query.formula.index()], history));
    case GroundQuery::Kind::kValueSensed:
      return answer(IsValueKnown(query, history));
  }
  return Answer::kNo;
}

bool WorldProgression::IsDetermined(const Formula& formula, const History& history) const {
  return std::ranges::all_of(history.worlds, [&](const World& w) { return IsTrue(formula, w); }) ||
         std::ranges::all_of(history.worlds, [&](const World& w) { return IsFalse(formula, w); });
}

bool WorldProgression::IsValueKnown(const GroundQuery& query, const History& history) const {
  const auto sensed = history.values_sensed.find(query.function);
  const bool is_sensed = sensed != history.values_sensed.end();
  if (is_sensed && (!query.within || sensed->second <= *query.within)) return true;
  const int slot = task_.functions[query.function.index()].slot;
  if (slot < 0) return false;
  const auto [least, most] = std::minmax_element(
      history.worlds.begin(), history.worlds.end(),
      [&](const World& a, const World& b) { return a.numbers[slot] < b.numbers[slot]; });
  return WidthOf(least->numbers[slot].value, most->numbers[slot].value) <=
         2 * query.within.value_or(0);
}

bool WorldProgression::HasTooMany(const Worlds& worlds) {
  if (worlds.size() <= most_worlds_) return false;
  has_made_too_many_ = true;
  return true;
}

void WorldProgression::SplitBy(AtomId atom, Worlds& worlds) {
  for (std::size_t i = 0, count = worlds.size(); i < count && !HasTooMany(worlds); ++i) {
    if (worlds[i].atoms[atom.index()] != Truth::kEither) continue;
    World other = worlds[i];
    other.atoms[atom.index()] = Truth::kFalse;
    worlds[i].atoms[atom.index()] = Truth::kTrue;
    MakeOnlyValue(atom, worlds[i]);
    worlds.push_back(std::move(other));
  }
}

void WorldProgression::MakeOnlyValue(AtomId atom, World& world) const {
  const FunctionId function = task_.function_of_atom[atom.index()];
  if (function.IsNone()) return;
  for (const AtomId value : task_.functions[function.index()].values) {
    if (value != atom) world.atoms[value.index()] = Truth::kFalse;
  }
}

void WorldProgression::Apply(const std::vector<GroundEffect>& effects, History& history) {
  for (const GroundEffect& effect : effects) {
    if (effect.is_of_worlds) SplitByAll(effect.condition, history.worlds);
  }
  std::vector<bool> happens_in_all;
  std::vector<bool> may_happen;
  for (const GroundEffect& effect : effects) {
    happens_in_all.push_back(Happens(effect, history));
    may_happen.push_back(happens_in_all.back() || MayHappen(effect, history.worlds));
  }
  std::map<FunctionId, double> sensed_values;
  std::set<FormulaId> sensed;
  for (std::size_t e = 0; e < effects.size(); ++e) {
    if (!happens_in_all[e]) continue;
    for (const GroundChange& change : effects[e].changes) {
      if (change.kind == GroundChange::Kind::kSense) sensed.insert(change.formula);
      if (change.kind == GroundChange::Kind::kSenseValue) {
        const auto [sensed_value, is_new] =
            sensed_values.try_emplace(change.function, change.error);
        sensed_value->second = std::min(sensed_value->second, change.error);
      }
    }
  }
  ForgetSensed(effects, may_happen, history);
  ChangeWorlds(effects, happens_in_all, history.worlds);
  history.sensed.merge(sensed);
  for (const auto& [function, error] : sensed_values) {
    const auto [known, is_new] = history.values_sensed.try_emplace(function, error);
    known->second = std::min(known->second, error);
  }
}

// Returns true if the executor of the plan knows that the effect's condition holds.
bool WorldProgression::Happens(const GroundEffect& effect, const History& history) {
  const Answer answer = Ask(effect.condition, history);
  could_not_tell_ |= answer == Answer::kCannotTell;
  return answer == Answer::kYes;
}

bool WorldProgression::MayHappen(const GroundEffect& effect, const Worlds& worlds) const {
  return effect.is_of_worlds && std::any_of(worlds.begin(), worlds.end(), [&](const World& world) {
           return IsTrue(effect.condition, world);
         });
}

void WorldProgression::SplitByAll(const GroundQuery& condition, Worlds& worlds) {
  if (condition.kind == GroundQuery::Kind::kKnown) SplitBy(condition.literal.atom, worlds);
  for (const GroundQuery& operand : condition.operands) SplitByAll(operand, worlds);
}

// Removes the sensed facts that may have changed since and are out of date.
void WorldProgression::ForgetSensed(const std::vector<GroundEffect>& effects,
                                    const std::vector<bool>& may_happen, History& history) const {
  for (std::size_t e = 0; e < effects.size(); ++e) {
    if (!may_happen[e]) continue;
    for (const GroundChange& change : effects[e].changes) ForgetSensed(change, history);
  }
}

void WorldProgression::ForgetSensed(const GroundChange& change, History& history) const {
  if (change.kind == GroundChange::Kind::kUnsense) history.sensed.erase(change.formula);
  if (change.kind == GroundChange::Kind::kUnsenseValue) {
    history.values_sensed.erase(change.function);
  }
  const bool is_of_number = change.kind == GroundChange::Kind::kAssign ||
                            change.kind == GroundChange::Kind::kForgetNumber;
  const AtomId atom = change.literal.atom;
  if (atom.IsNone() && !is_of_number) return;
  const FunctionId function = is_of_number ? change.function : task_.function_of_atom[atom.index()];
  history.values_sensed.erase(function);
  std::erase_if(history.sensed, [&](FormulaId formula) {
    const Formula& f = task_.formulas[formula.index()];
    return (f.bound && f.bound->function == function) ||
           std::any_of(f.literals.begin(), f.literals.end(),
                       [&](const GroundLiteral& l) { return l.atom == atom; });
  });
}

void WorldProgression::ChangeWorlds(const std::vector<GroundEffect>& effects,
                                    const std::vector<bool>& happens, Worlds& worlds) {
  Worlds changed;
  std::size_t most_before_merging = most_worlds_;
  for (const World& world : worlds) {
    if (changed.size() > most_before_merging) {
      MergeEqual(changed);
      if (HasTooMany(changed)) break;
      most_before_merging = std::max(most_worlds_, 2 * changed.size());
    }
    Worlds now = {world};
    std::map<FunctionId, const GroundChange*> given;
    for (int pass = 0; pass < kPasses; ++pass) {
      for (std::size_t e = 0; e < effects.size(); ++e) {
        const bool is_known = happens[e];  // the executor knows that the condition holds
        const bool applies =
            effects[e].is_of_worlds ? IsTrue(effects[e].condition, world) : is_known;
        if (!applies) continue;
        for (const GroundChange& change : effects[e].changes) {
          if (PassOf(change) != pass || (!is_known && IsAsserted(change))) continue;
          NoteValue(change, given);
          Change(change, world, now);
        }
      }
    }
    std::move(now.begin(), now.end(), std::back_inserter(changed));
  }
  for (int slot = 0; slot < std::ssize(task_.function_of_slot); ++slot) {
    OpenForgotten(slot, changed);
  }
  if (changed.size() > worlds.size()) MergeEqual(changed);
  worlds = std::move(changed);
}

void WorldProgression::NoteValue(const GroundChange& change,
                                 std::map<FunctionId, const GroundChange*>& given) {
  const FunctionId function = FunctionGiven(task_, change);
  if (function.IsNone()) return;
  const auto [first, is_new] = given.try_emplace(function, &change);
  if (!is_new && GiveTwoValues(task_, *first->second, change)) two_valued_ = function;
}

void WorldProgression::Change(const GroundChange& change, const World& before, Worlds& now) {
  switch (change.kind) {
    case GroundChange::Kind::kSet:
      for (World& world : now) {
        world.atoms[change.literal.atom.index()] =
            change.literal.is_positive ? Truth::kTrue : Truth::kFalse;
      }
      return;
    case GroundChange::Kind::kForget:
      for (World& world : now) world.atoms[change.literal.atom.index()] = Truth::kEither;
      return;
    case GroundChange::Kind::kAssign:
      return Assign(change, before, now);
    case GroundChange::Kind::kNarrow:
      OpenForgotten(task_.functions[change.bound.function.index()].slot, now);
      std::erase_if(now, [&](const World& world) { return !IsTrue(change.bound, world); });
      return;
    case GroundChange::Kind::kRelate:
      for (const GroundLiteral& l : change.literals) SplitBy(l.atom, now);
      std::erase_if(now, [&](const World& world) {
        const auto holding =
            std::count_if(change.literals.begin(), change.literals.end(),
                          [&](const GroundLiteral& l) { return IsTrue(l, world); });
        return holding == 0 || (holding > 1 && !change.is_inclusive);
      });
      return;
    case GroundChange::Kind::kSense:
    case GroundChange::Kind::kUnsense:
    case GroundChange::Kind::kSenseValue:
    case GroundChange::Kind::kUnsenseValue:
      return;
    case GroundChange::Kind::kForgetNumber:
      for (World& world : now) {
        world.numbers[task_.functions[change.function.index()].slot] = kForgotten;
      }
      return;
  }
}

// Worlds that differ only in the forgotten number are merged before the number is replaced by every
// possible number.
void WorldProgression::OpenForgotten(int slot, Worlds& worlds) const {
  const auto is_kept = [&](const World& world) { return world.numbers[slot] != kForgotten; };
  const auto forgotten = std::partition(worlds.begin(), worlds.end(), is_kept);
  if (forgotten == worlds.end()) return;
  const std::set<World> different(forgotten, worlds.end());
  worlds.erase(forgotten, worlds.end());
  for (const Number& value : marks_.In({-kInfinity, kInfinity}, slot)) {
    for (const World& world : different) {
      worlds.push_back(world);
      worlds.back().numbers[slot] = value;
    }
  }
}

void WorldProgression::Assign(const GroundChange& change, const World& before, Worlds& now) const {
  const int slot = task_.functions[change.function.index()].slot;
  Number sum;
  for (const auto& [function, sign] : change.sum.functions) {
    const Number& number = before.numbers[task_.functions[function.index()].slot];
    sum.value = NearestSum(sum.value, sign * number.value);
    sum.beside = std::clamp(sum.beside + sign * number.beside, -1, 1);
  }
  const Interval& added = change.sum.constant;
  Worlds all;
  const Number low{NearestSum(sum.value, added.low), sum.beside};
  const Number high{NearestSum(sum.value, added.high), sum.beside};
  const bool is_sum = !change.sum.functions.empty();
  for (const Number& number :
       is_sum ? marks_.BetweenSums(low, high, slot) : marks_.Between(low, high, slot)) {
    for (const World& world : now) {
      all.push_back(world);
      all.back().numbers[slot] = number;
    }
  }
  now = std::move(all);
}

void WorldProgression::Update(History& history) {
  if (task_.updates.empty()) return;
  for (std::size_t round = 0; round <= MostRoundsOf(task_) && !has_made_too_many_; ++round) {
    const History before = history;
    for (const GroundEffect& update : task_.updates) {
      if (!Happens(update, history)) continue;
      GroundEffect always = update;
      always.condition = {};
      Apply({always}, history);
    }
    if (history == before) return;
  }
  is_restless_ |= !has_made_too_many_;
}

}  // namespace assay::contingent
