#include "planner/contingent/world_sets/symbolic_worlds.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "planner/contingent/world_sets/variable_order.h"

namespace assay::contingent {

// The worlds where an effect makes an atom true, makes it false, or lets it be either.
struct SymbolicWorlds::Fate {
  Diagram becomes_true = kEmptySet;
  Diagram becomes_false = kEmptySet;
  Diagram becomes_open = kEmptySet;

  // Returns true if the effect is the same in all worlds.
  bool IsCertain() const {
    const auto is_somewhere = [](Diagram where) { return where != kEmptySet && where != kAllSets; };
    return !is_somewhere(becomes_true) && !is_somewhere(becomes_false) &&
           !is_somewhere(becomes_open);
  }
  bool IsOpen() const { return becomes_true == kEmptySet && becomes_false == kEmptySet; }
};

SymbolicWorlds::SymbolicWorlds(const GroundTask& task)
    : task_(task), places_(PlacesOfAtoms(task)) {}

Diagram SymbolicWorlds::Where(GroundLiteral literal) {
  return Literal({Variable(literal.atom), literal.is_positive});
}

Diagram SymbolicWorlds::Where(const GroundQuery& condition) {
  if (condition.kind == GroundQuery::Kind::kKnown) return Where(condition.literal);
  const bool is_and = condition.kind == GroundQuery::Kind::kAnd;
  Diagram where = is_and ? kAllSets : kEmptySet;
  for (const GroundQuery& operand : condition.operands) {
    const Diagram there = Where(operand);
    where = is_and ? And(where, there) : Or(where, there);
  }
  return where;
}

Diagram SymbolicWorlds::Where(const Formula& conjunction) {
  Diagram where = kAllSets;
  for (const GroundLiteral& l : conjunction.literals) where = And(where, Where(l));
  return where;
}

Diagram SymbolicWorlds::Initial() {
  Diagram worlds = kAllSets;
  for (const InitialRelation& relation : task_.initial.relations) {
    std::vector<Assignment> literals;
    for (const GroundLiteral& l : relation.literals) {
      literals.push_back({Variable(l.atom), l.is_positive});
    }
    worlds = And(worlds, relation.is_inclusive ? AtLeastOne(literals) : ExactlyOne(literals));
  }
  std::vector<Assignment> known;
  for (const GroundLiteral& l : task_.initial.known) {
    known.push_back({Variable(l.atom), l.is_positive});
  }
  std::ranges::sort(known, {}, &Assignment::variable);
  return Restrict(worlds, known);
}

Diagram SymbolicWorlds::Assumed(Diagram worlds) {
  for (const GroundLiteral& l : task_.initial.known) worlds = And(worlds, Where(l));
  return worlds;
}

std::set<AtomId> SymbolicWorlds::OpenAtoms(Diagram initial) {
  const std::vector<int>& said = Support(initial);
  std::set<AtomId> open;
  for (std::size_t a = 0; a < task_.atoms.size(); ++a) {
    if (!std::ranges::binary_search(said, Variable(AtomId(a)))) open.insert(AtomId(a));
  }
  for (const GroundLiteral& l : task_.initial.known) open.erase(l.atom);
  return open;
}

double SymbolicWorlds::CountOf(Diagram worlds) {
  std::set<int> open;
  for (const InitialRelation& relation : task_.initial.relations) {
    for (const GroundLiteral& l : relation.literals) open.insert(Variable(l.atom));
  }
  for (const GroundLiteral& l : task_.initial.known) open.erase(Variable(l.atom));
  std::unordered_map<Diagram, double> shares = {{kEmptySet, 0}, {kAllSets, 1}};
  return std::round(std::ldexp(ShareOf(worlds, shares), static_cast<int>(open.size())));
}

// Returns the share of all assignments that is in the set.
double SymbolicWorlds::ShareOf(Diagram f, std::unordered_map<Diagram, double>& known) {
  if (const auto found = known.find(f); found != known.end()) return found->second;
  const double share = (ShareOf(low(f), known) + ShareOf(high(f), known)) / 2;
  return known[f] = share;
}

std::map<AtomId, SymbolicWorlds::Fate> SymbolicWorlds::FatesOf(const GroundAction& action) {
  std::map<AtomId, Fate> fates;
  for (const GroundEffect& effect : action.effects) {
    const Diagram where = Where(effect.condition);
    for (const GroundChange& change : effect.changes) {
      if (change.literal.atom.IsNone()) continue;
      Fate& fate = fates[change.literal.atom];
      Diagram& becomes = change.kind == GroundChange::Kind::kForget ? fate.becomes_open
                         : change.literal.is_positive               ? fate.becomes_true
                                                                    : fate.becomes_false;
      becomes = Or(becomes, where);
    }
  }
  return fates;
}

// The new value of an atom whose fate depends on the world is a variable of its own during the
// computation.
Diagram SymbolicWorlds::Image(const GroundAction& action, Diagram worlds) {
  const std::map<AtomId, Fate> fates = FatesOf(action);
  std::unordered_map<int, Diagram> renamed;
  for (const auto& [atom, fate] : fates) {
    if (fate.IsCertain()) continue;
    worlds = And(worlds, NewValue(atom, fate));
    renamed[Variable(atom) + 1] = Literal({Variable(atom), true});
  }
  for (const auto& [atom, fate] : fates) worlds = Exists(worlds, Variable(atom));
  worlds = Compose(worlds, renamed);
  for (const auto& [atom, fate] : fates) {
    if (!fate.IsCertain() || fate.IsOpen()) continue;
    worlds = And(worlds, Where({atom, fate.becomes_true == kAllSets}));
  }
  return worlds;
}

// Becoming true wins over becoming false, and both win over becoming open.
Diagram SymbolicWorlds::NewValue(AtomId atom, const Fate& fate) {
  const Diagram now = Literal({Variable(atom) + 1, true});
  const Diagram stays = Equal(now, Literal({Variable(atom), true}));
  const Diagram or_open = IfThenElse(fate.becomes_open, kAllSets, stays);
  const Diagram or_false = IfThenElse(fate.becomes_false, Not(now), or_open);
  return IfThenElse(fate.becomes_true, now, or_false);
}

std::string SymbolicWorlds::TextOfAWorld(Diagram worlds) const {
  std::set<int> holding;
  while (!IsConstant(worlds)) {
    const bool can_be_false = low(worlds) != kEmptySet;
    if (!can_be_false) holding.insert(variable(worlds));
    worlds = can_be_false ? low(worlds) : high(worlds);
  }
  std::vector<std::string> texts;
  for (std::size_t a = 0; a < task_.atoms.size(); ++a) {
    if (holding.contains(Variable(AtomId(a)))) texts.push_back(task_.atoms[a]);
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace assay::contingent
