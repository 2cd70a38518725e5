#include "planner/contingent/knowledge/atom_knowledge.h"

#include <algorithm>
#include <set>
#include <unordered_map>
#include <utility>

#include "planner/base/check.h"

namespace assay::contingent {

AtomKnowledge::AtomKnowledge(const GroundTask& task)
    : task_(task), layout_(task), worlds_(task), formulas_of_atom_(task.atoms.size()) {
  for (std::size_t f = 0; f < task.formulas.size(); ++f) {
    for (const GroundLiteral& literal : task.formulas[f].literals) {
      formulas_of_atom_[literal.atom.index()].push_back(FormulaId(f));
    }
  }
}

bool AtomKnowledge::IsWithin(const KnowledgeState& state, Diagram worlds) {
  // Most sets are decided by the known atoms alone, without further work.
  while (!worlds_.IsConstant(worlds)) {
    const AtomId atom = worlds_.AtomOf(worlds_.variable(worlds));
    if (layout_.IsKnown(state, {atom, true})) {
      worlds = worlds_.high(worlds);
    } else if (layout_.IsKnown(state, {atom, false})) {
      worlds = worlds_.low(worlds);
    } else {
      break;
    }
  }
  const Diagram restricted = Restricted(worlds, state);
  if (worlds_.IsConstant(restricted)) return restricted == kAllSets;
  return worlds_.Implies(RelationsWith(state, restricted), restricted);
}

Diagram AtomKnowledge::Restricted(Diagram worlds, const KnowledgeState& state) {
  std::vector<Assignment> known;
  for (const int variable : worlds_.Support(worlds)) {
    if (!worlds_.IsOfAtom(variable)) continue;
    for (const bool value : {true, false}) {
      if (layout_.IsKnown(state, {worlds_.AtomOf(variable), value}))
        known.push_back({variable, value});
    }
  }
  return worlds_.Restrict(worlds, known);
}

Diagram AtomKnowledge::RelationsWith(const KnowledgeState& state, Diagram of) {
  KnowledgeState rest = state;
  return TakeRelations(rest, worlds_.Support(of));
}

Diagram AtomKnowledge::RelationOf(const KnowledgeState& state, AtomId atom) {
  for (const Diagram relation : state.relations) {
    const std::vector<int>& support = worlds_.Support(relation);
    if (std::binary_search(support.begin(), support.end(), worlds_.Variable(atom))) return relation;
  }
  return kAllSets;
}

// ---- Changes of the world

void AtomKnowledge::Set(KnowledgeState& state, GroundLiteral literal) {
  UnsenseWith(state, literal.atom);
  if (layout_.IsUndetermined(state, literal.atom)) Unrelate(state, literal.atom);
  Disentangle(state, literal.atom);
  layout_.SetKnown(state, literal);
}

void AtomKnowledge::Forget(KnowledgeState& state, AtomId atom) {
  UnsenseWith(state, atom);
  if (layout_.IsUndetermined(state, atom)) Unrelate(state, atom);
  Disentangle(state, atom);
  layout_.SetUnknown(state, atom);
}

void AtomKnowledge::Disentangle(KnowledgeState& state, AtomId atom) const {
  layout_.SetEntangled(state, atom, false);
  layout_.SetOuter(state, atom, false);
}

void AtomKnowledge::Entangle(KnowledgeState& state, AtomId atom, bool is_outer) const {
  layout_.SetEntangled(state, atom, true);
  if (is_outer) layout_.SetOuter(state, atom, true);
}

void AtomKnowledge::Entangle(KnowledgeState& state, Diagram worlds) {
  for (const int variable : worlds_.Support(worlds)) {
    if (worlds_.IsOfAtom(variable)) Entangle(state, worlds_.AtomOf(variable), false);
  }
  SpreadEntanglement(state);
}

void AtomKnowledge::SpreadEntanglement(KnowledgeState& state) {
  for (const Diagram relation : state.relations) {
    SpreadEntanglement(state, worlds_.Support(relation));
  }
}

void AtomKnowledge::SpreadEntanglement(KnowledgeState& state,
                                       const std::vector<int>& variables) const {
  bool are_entangled = false;
  bool are_outer = false;
  for (const int variable : variables) {
    if (!worlds_.IsOfAtom(variable)) continue;
    are_entangled |= layout_.IsEntangled(state, worlds_.AtomOf(variable));
    are_outer |= layout_.IsOuter(state, worlds_.AtomOf(variable));
  }
  if (!are_entangled) return;
  for (const int variable : variables) {
    if (worlds_.IsOfAtom(variable)) Entangle(state, worlds_.AtomOf(variable), are_outer);
  }
}

// The values of one function exclude each other, although no relation is stored. Knowledge that the
// state does not express about one value therefore concerns all values of the function.
bool AtomKnowledge::IsOuter(const KnowledgeState& state, AtomId atom) const {
  const FunctionId function = task_.function_of_atom[atom.index()];
  if (function.IsNone()) return layout_.IsOuter(state, atom);
  return std::ranges::any_of(task_.functions[function.index()].values,
                             [&](AtomId value) { return layout_.IsOuter(state, value); });
}

void AtomKnowledge::UnsenseWith(KnowledgeState& state, AtomId atom) {
  for (const FormulaId formula : formulas_of_atom_[atom.index()]) {
    layout_.SetSensed(state, formula, false);
  }
  const FunctionId function = task_.function_of_atom[atom.index()];
  if (!function.IsNone()) layout_.SetSensed(state, function, false);
}

void AtomKnowledge::Unrelate(KnowledgeState& state, AtomId atom) {
  const Diagram relation = RelationOf(state, atom);
  if (relation == kAllSets) return;
  std::erase(state.relations, relation);
  PutRelation(state, worlds_.Exists(relation, worlds_.Variable(atom)));
}

// Computes the image of the relations under "x becomes true where A, else false where D, else
// either where O". The new x is a variable of its own during the computation. Where it is not open
// it equals A | (x & !D), and afterwards the old x is quantified away. The relations are conjoined
// first because they keep the diagrams small.
void AtomKnowledge::Change(KnowledgeState& state, const std::map<AtomId, PossibleChange>& changes,
                           const OpenBounds& bounds) {
  std::vector<int> variables;
  std::vector<Diagram> transitions;
  for (const auto& [atom, where] : changes) {
    const Diagram old = Restricted(worlds_.Where({atom, true}), state);
    const Diagram now =
        worlds_.Or(where.becomes_true, worlds_.And(old, worlds_.Not(where.becomes_false)));
    const Diagram is_open = worlds_.And(
        where.becomes_open, worlds_.Not(worlds_.Or(where.becomes_true, where.becomes_false)));
    transitions.push_back(worlds_.Or(
        is_open, worlds_.Equal(worlds_.Literal({worlds_.NewVariable(atom), true}), now)));
    const std::vector<int>& of_transition = worlds_.Support(transitions.back());
    variables.insert(variables.end(), of_transition.begin(), of_transition.end());
    variables.push_back(worlds_.Variable(atom));
    UnsenseWith(state, atom);
  }
  // An atom that an entangled atom decides is entangled too, whatever becomes of the first atom.
  SpreadEntanglement(state, variables);
  Diagram image = worlds_.And(TakeRelations(state, variables), bounds.Together());
  for (const Diagram transition : transitions) image = worlds_.And(image, transition);
  for (const int bound : bounds.Variables()) image = worlds_.Exists(image, bound);
  std::unordered_map<int, Diagram> renamed;
  for (const auto& [atom, where] : changes) {
    image = worlds_.Exists(image, worlds_.Variable(atom));
    renamed[worlds_.NewVariable(atom)] = worlds_.Where({atom, true});
    layout_.SetUnknown(state, atom);
  }
  // An open atom obeys unique names like any value of a function.
  image = worlds_.Compose(image, renamed);
  image = worlds_.And(image, UniqueNames(worlds_.Support(image), state));
  const bool can_hold = PutRelation(state, image);
  ASSAY_CHECK(can_hold, "an effect left no world");
  if (!bounds.Variables().empty()) {
    for (const auto& [atom, where] : changes) Entangle(state, atom, bounds.AreOuter());
    SpreadEntanglement(state);
  }
}

// ---- New knowledge of the unchanged world

void AtomKnowledge::Learn(KnowledgeState& state, GroundLiteral literal) {
  if (!layout_.IsUndetermined(state, literal.atom)) return;
  if (layout_.IsEntangled(state, literal.atom)) LearnOfNumbers(state);
  const Diagram relation = RelationOf(state, literal.atom);
  layout_.SetKnown(state, literal);
  if (relation != kAllSets) {
    std::erase(state.relations, relation);
    const bool can_hold = PutRelation(
        state, worlds_.Cofactor(relation, {worlds_.Variable(literal.atom), literal.is_positive}));
    ASSAY_CHECK(can_hold, "learned what cannot be: {}", TextOf(task_, literal));
  }
  // A function has one value (unique names).
  const FunctionId function = task_.function_of_atom[literal.atom.index()];
  if (!literal.is_positive || function.IsNone()) return;
  for (const AtomId value : task_.functions[function.index()].values) {
    if (value != literal.atom) Learn(state, {value, false});
  }
}

// A conjunction that is false does not say which of its literals are false.
bool AtomKnowledge::LearnConjunction(KnowledgeState& state,
                                     const std::vector<GroundLiteral>& literals, bool value) {
  const Diagram where = worlds_.WhereAll(literals);
  return RelateAsWell(state, Restricted(value ? where : worlds_.Not(where), state));
}

bool AtomKnowledge::Relate(KnowledgeState& state, const std::vector<GroundLiteral>& literals,
                           bool is_inclusive) {
  return RelateAsWell(state, Restricted(worlds_.WhereOne(literals, is_inclusive), state));
}

bool AtomKnowledge::RelateAsWell(KnowledgeState& state, Diagram relation) {
  const std::vector<int>& variables = worlds_.Support(relation);
  const bool tells_of_numbers = std::ranges::any_of(variables, [&](int variable) {
    return layout_.IsEntangled(state, worlds_.AtomOf(variable));
  });
  if (tells_of_numbers) LearnOfNumbers(state);
  return PutRelation(state, worlds_.And(relation, TakeRelations(state, variables)));
}

// ---- Relations

Diagram AtomKnowledge::TakeRelations(KnowledgeState& state, std::vector<int> wanted) {
  Diagram all = kAllSets;
  std::set<FunctionId> functions;
  std::vector<int> fresh = std::move(wanted);
  while (!fresh.empty()) {
    std::vector<int> next;
    for (std::size_t i = 0, count = fresh.size(); i < count; ++i) {
      const FunctionId function = FunctionOf(fresh[i]);
      if (function.IsNone() || !functions.insert(function).second) continue;
      const std::vector<int> values = OpenValues(function, state);
      all = worlds_.And(all, UniqueNames(values, state));
      fresh.insert(fresh.end(), values.begin(), values.end());
    }
    std::erase_if(state.relations, [&](Diagram relation) {
      const std::vector<int>& support = worlds_.Support(relation);
      const bool shares = std::any_of(fresh.begin(), fresh.end(), [&](int variable) {
        return std::binary_search(support.begin(), support.end(), variable);
      });
      if (!shares) return false;
      all = worlds_.And(all, relation);
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

bool AtomKnowledge::PutRelation(KnowledgeState& state, Diagram relation) {
  if (relation == kEmptySet) return false;
  const std::vector<Assignment> known = worlds_.Essential(relation);
  relation = worlds_.Restrict(relation, known);
  // A relation that says no more than unique names is not stored.
  if (relation != UniqueNames(worlds_.Support(relation), state)) {
    state.relations.insert(
        std::lower_bound(state.relations.begin(), state.relations.end(), relation), relation);
    SpreadEntanglement(state, worlds_.Support(relation));
  }
  for (const Assignment& a : known) Learn(state, {worlds_.AtomOf(a.variable), a.value});
  return true;
}

FunctionId AtomKnowledge::FunctionOf(int variable) const {
  return worlds_.IsOfAtom(variable) ? task_.function_of_atom[worlds_.AtomOf(variable).index()]
                                    : FunctionId::None();
}

std::vector<int> AtomKnowledge::OpenValues(FunctionId function, const KnowledgeState& state) const {
  std::vector<int> open;
  for (const AtomId value : task_.functions[function.index()].values) {
    if (layout_.IsUndetermined(state, value)) open.push_back(worlds_.Variable(value));
  }
  return open;
}

Diagram AtomKnowledge::UniqueNames(const std::vector<int>& variables, const KnowledgeState& state) {
  std::map<FunctionId, std::vector<Assignment>> values;
  for (const int variable : variables) {
    const FunctionId function = FunctionOf(variable);
    if (function.IsNone() || !layout_.IsUndetermined(state, worlds_.AtomOf(variable))) continue;
    values[function].push_back({variable, true});
  }
  Diagram unique = kAllSets;
  for (const auto& [function, open] : values) {
    if (open.size() == 1) continue;
    const Diagram is_none = worlds_.Not(worlds_.AtLeastOne(open));
    unique = worlds_.And(unique, worlds_.Or(is_none, worlds_.ExactlyOne(open)));
  }
  return unique;
}

}  // namespace assay::contingent
