#include "planner/contingent/grounding/atom_table.h"

#include <algorithm>

namespace assay::contingent {

std::string AtomText(const std::string& name, const std::vector<std::string>& arguments) {
  if (arguments.empty()) return name;
  std::string text = name + "(";
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (i > 0) text += ", ";
    text += arguments[i];
  }
  return text + ")";
}

AtomTable::AtomTable(const Domain& domain, const Problem& problem, const SymbolTable& symbols,
                     GroundTask& task)
    : symbols_(symbols), task_(task) {
  for (const Action& action : domain.actions) {
    for (const Effect& effect : action.effects) FindChanged(effect);
  }
  for (const Effect& effect : domain.updates) FindChanged(effect);
  for (const Change& change : problem.init) {
    if (change.store == Store::kValues) sensed_.insert(change.terms.front().name);
  }
}

void AtomTable::FindChanged(const Effect& effect) {
  for (const Change& change : effect.changes) {
    if (change.store == Store::kValues) sensed_.insert(change.terms.front().name);
    if (change.store != Store::kFacts && change.store != Store::kExclusive) continue;
    for (const Literal& literal : change.literals) {
      const bool is_predicate = literal.relation == Relation::kPredicate;
      changed_.insert(is_predicate ? literal.predicate : literal.arguments.front().name);
    }
  }
}

Knowledge AtomTable::AlwaysKnown(const std::string& predicate,
                                 const std::vector<std::string>& arguments) {
  if (IsChanged(predicate)) return Knowledge::kUnknown;
  return AtFirst(AtomText(predicate, arguments), {predicate, arguments});
}

AtomId AtomTable::Atom(const std::string& predicate, const std::vector<std::string>& arguments) {
  return Intern(AtomText(predicate, arguments), {predicate, arguments}, {predicate, arguments},
                FunctionId::None());
}

AtomId AtomTable::Intern(const std::string& text, Key key, GroundAtom atom, FunctionId function) {
  const auto [entry, is_new] = atoms_.try_emplace(text, AtomId(task_.atoms.size()));
  if (is_new) {
    task_.atoms.push_back(text);
    task_.ground_atoms.push_back(std::move(atom));
    task_.function_of_atom.push_back(function);
    keys_.push_back(std::move(key));
  }
  return entry->second;
}

FunctionId AtomTable::Function(const std::string& name, const std::vector<std::string>& arguments) {
  const std::string text = AtomText(name, arguments);
  const auto [entry, is_new] = functions_.try_emplace(text, FunctionId(task_.functions.size()));
  if (!is_new) return entry->second;
  const FunctionId id = entry->second;
  GroundFunction function;
  function.text = text;
  function.symbol = name;
  function.arguments = arguments;
  const std::string& range = symbols_.FindFunction(name)->range;
  if (range == kNumberType) {
    function.slot = static_cast<int>(task_.function_of_slot.size());
    task_.function_of_slot.push_back(id);
  } else {
    function.constants = symbols_.ConstantsOf(range);
    for (const std::string& constant : function.constants) {
      std::vector<std::string> symbols = arguments;
      symbols.push_back(constant);
      function.values.push_back(
          Intern(text + " = " + constant, {text, {constant}}, {name, symbols}, id));
    }
  }
  task_.functions.push_back(std::move(function));
  return id;
}

AtomId AtomTable::Value(FunctionId function, const std::string& constant) const {
  const GroundFunction& f = task_.functions[function.index()];
  const auto found = std::find(f.constants.begin(), f.constants.end(), constant);
  return found != f.constants.end() ? f.values[found - f.constants.begin()] : AtomId::None();
}

FormulaId AtomTable::IdOf(const Formula& formula) {
  const auto [entry, is_new] =
      formulas_.try_emplace(TextOf(task_, formula), FormulaId(task_.formulas.size()));
  if (is_new) task_.formulas.push_back(formula);
  return entry->second;
}

Knowledge AtomTable::AtFirst(const std::string& text, const Key& key) const {
  const auto stated = stated_.find(text);
  if (stated != stated_.end()) return stated->second;
  return IsClosed(key) ? Knowledge::kFalse : Knowledge::kUnknown;
}

bool AtomTable::IsClosed(const Key& key) const {
  const auto closed = closed_.find(key.predicate);
  return closed != closed_.end() &&
         std::any_of(closed->second.begin(), closed->second.end(),
                     [&](const Change* change) { return Matches(*change, key); });
}

// Returns true if the atom is an instance of the LCW formula.
bool AtomTable::Matches(const Change& closed, const Key& key) const {
  std::map<std::string, std::string> binding;
  const std::vector<Term>& terms = closed.literals.front().arguments;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const std::string& argument = key.arguments[i];
    if (terms[i].kind == Term::Kind::kConstant) {
      if (terms[i].name != argument) return false;
    } else if (binding.try_emplace(terms[i].name, argument).first->second != argument) {
      return false;
    }
  }
  return std::all_of(closed.variables.begin(), closed.variables.end(), [&](const TypedName& v) {
    const TypedName* const constant = symbols_.FindConstant(binding[v.name]);
    return constant == nullptr || symbols_.IsA(constant->type, v.type);
  });
}

std::vector<std::vector<std::string>> AtomTable::ArgumentsOf(const Symbol& predicate) const {
  std::vector<std::vector<std::string>> all = {{}};
  for (const TypedName& parameter : predicate.parameters) {
    std::vector<std::vector<std::string>> longer;
    for (const std::vector<std::string>& arguments : all) {
      for (const std::string& constant : symbols_.ConstantsOf(parameter.type)) {
        longer.push_back(arguments);
        longer.back().push_back(constant);
      }
    }
    all = std::move(longer);
  }
  return all;
}

void AtomTable::AddKnown() {
  for (const std::string& name : symbols_.PredicateNames()) {
    for (const std::vector<std::string>& arguments : ArgumentsOf(*symbols_.FindPredicate(name))) {
      const Knowledge knowledge = AtFirst(AtomText(name, arguments), {name, arguments});
      if (knowledge != Knowledge::kUnknown) Atom(name, arguments);
    }
  }
}

std::vector<GroundLiteral> AtomTable::KnownAtFirst() const {
  std::vector<GroundLiteral> known;
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    const Knowledge knowledge = AtFirst(task_.atoms[i], keys_[i]);
    if (knowledge == Knowledge::kUnknown) continue;
    known.push_back({AtomId(i), knowledge == Knowledge::kTrue});
  }
  return known;
}

}  // namespace assay::contingent
