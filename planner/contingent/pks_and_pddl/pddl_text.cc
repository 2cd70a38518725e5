#include "planner/contingent/pks_and_pddl/pddl_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <set>
#include <utility>

#include "planner/contingent/language/spelling.h"

namespace assay::contingent {
namespace {

// Returns the text as a PDDL name, in small letters, because PDDL ignores case.
std::string NameOf(const std::string& text) {
  std::string name = Spelled(text);
  for (char& c : name) c = 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return name;
}

class PddlWriter {
 public:
  PddlWriter(const GroundTask& task, const std::string& name)
      : task_(task), name_(NameOf(name)), tells_false_(task.atoms.size(), false) {
    std::set<std::string> taken;
    for (const std::string& atom : task.atoms) atoms_.push_back(Unique(NameOf(atom), taken));
    FindWhereFalseTells();
  }

  PddlFiles Write() {
    for (const GroundEffect& update : task_.updates) {
      Enter(update.place);
      Fail("update rules");
    }
    return {WriteDomain(), WriteProblem()};
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw InputError(place_, fmt::format("PDDL has no {}", what),
                     "facts, functions of objects, Kw of single atoms and Kx");
  }

  void Enter(Place place) { place_ = {task_.domain_file, place.line, place.column}; }

  // Marks the atoms for which the task distinguishes false from unknown.
  void FindWhereFalseTells() {
    for (const Formula& formula : task_.formulas) {
      for (const GroundLiteral& literal : formula.literals) Mark(literal);
    }
    for (const GroundAction& action : task_.actions) {
      ForEachLiteral(action.precondition, [&](const GroundLiteral& literal) {
        if (!literal.is_positive) Mark(literal);
      });
      for (const GroundEffect& effect : action.effects) {
        ForEachLiteral(effect.condition, [&](const GroundLiteral& literal) { Mark(literal); });
      }
    }
    ForEachLiteral(task_.goal, [&](const GroundLiteral& literal) {
      if (!literal.is_positive) Mark(literal);
    });
  }

  void Mark(const GroundLiteral& literal) { tells_false_[literal.atom.index()] = true; }

  static void ForEachLiteral(const GroundQuery& query,
                             const std::function<void(const GroundLiteral&)>& use) {
    if (query.kind == GroundQuery::Kind::kKnown) use(query.literal);
    for (const GroundQuery& operand : query.operands) ForEachLiteral(operand, use);
  }

  std::string LiteralText(const GroundLiteral& literal) const {
    const std::string atom = fmt::format("({})", atoms_[literal.atom.index()]);
    return literal.is_positive ? atom : fmt::format("(not {})", atom);
  }

  std::string QueryText(const GroundQuery& query) const {
    switch (query.kind) {
      case GroundQuery::Kind::kKnown:
        return LiteralText(query.literal);
      case GroundQuery::Kind::kNot:
        Fail("queries of what is not known");
      case GroundQuery::Kind::kKnownWhether:
      case GroundQuery::Kind::kValueSensed:
        Fail("Kw and Kv in queries");
      case GroundQuery::Kind::kBoundKnown:
        Fail("intervals");
      case GroundQuery::Kind::kAnd:
      case GroundQuery::Kind::kOr:
        break;
    }
    std::string text = query.kind == GroundQuery::Kind::kAnd ? "(and" : "(or";
    for (const GroundQuery& operand : query.operands) {
      text += fmt::format(" {}", QueryText(operand));
    }
    return text + ")";
  }

  // Removes from the query all conditions that ask whether something is unknown.
  static GroundQuery WhatIsAskedOfWorlds(const GroundQuery& query) {
    if (query.kind == GroundQuery::Kind::kNot) return {};
    if (query.kind != GroundQuery::Kind::kAnd) return query;
    GroundQuery asked;
    for (const GroundQuery& operand : query.operands) {
      GroundQuery of_operand = WhatIsAskedOfWorlds(operand);
      if (!of_operand.IsTrue()) asked.operands.push_back(std::move(of_operand));
    }
    return asked;
  }

  static bool OnlySenses(const GroundAction& action) {
    return std::all_of(action.effects.begin(), action.effects.end(), [](const GroundEffect& e) {
      return std::all_of(e.changes.begin(), e.changes.end(), [](const GroundChange& c) {
        return c.kind == GroundChange::Kind::kSense;
      });
    });
  }

  std::string WriteDomain() {
    std::string text = fmt::format("(define (domain {})\n (:predicates", name_);
    for (const std::string& atom : atoms_) text += fmt::format(" ({})", atom);
    text += ")\n";
    std::set<std::string> taken;
    for (const GroundAction& action : task_.actions) text += ActionText(action, taken);
    return text + ")\n";
  }

  std::string ActionText(const GroundAction& action, std::set<std::string>& taken) {
    Enter(action.place);
    for (const FunctionId value : action.run_time_values) {
      if (!value.IsNone()) Fail("run-time variables");
    }
    std::string text = fmt::format(" (:action {}\n", Unique(NameOf(TextOf(action)), taken));
    const std::string precondition = QueryText(
        OnlySenses(action) ? WhatIsAskedOfWorlds(action.precondition) : action.precondition);
    if (precondition != "(and)") text += fmt::format("  :precondition {}\n", precondition);
    std::string effects;
    for (const GroundEffect& effect : action.effects) effects += EffectText(effect);
    if (!effects.empty()) text += fmt::format("  :effect (and{})\n", effects);
    if (const auto sensed = SensedBy(action)) {
      text += fmt::format("  :observe {}\n", LiteralText(*sensed));
    }
    return text + " )\n";
  }

  std::string EffectText(const GroundEffect& effect) const {
    std::string changes;
    for (const GroundChange& change : effect.changes) {
      if (change.kind == GroundChange::Kind::kSet)
        changes += fmt::format(" {}", LiteralText(change.literal));
      if (change.kind == GroundChange::Kind::kForget) {
        if (tells_false_[change.literal.atom.index()]) {
          Fail(
              fmt::format("del(Kf, {}): PDDL cannot tell false from unknown, and the problem "
                          "depends on the difference",
                          TextOf(task_, {change.literal.atom, true})));
        }
        changes += fmt::format(" {}", LiteralText({change.literal.atom, false}));
      }
      if (change.kind == GroundChange::Kind::kRelate) Fail("Kx in effects");
      if (change.kind == GroundChange::Kind::kSenseValue) Fail("Kv");
      if (change.kind == GroundChange::Kind::kAssign ||
          change.kind == GroundChange::Kind::kNarrow ||
          change.kind == GroundChange::Kind::kForgetNumber) {
        Fail("intervals");
      }
    }
    if (changes.empty() || effect.condition.IsTrue()) return changes;
    return fmt::format(" (when {} (and{}))", QueryText(effect.condition), changes);
  }

  std::optional<GroundLiteral> SensedBy(const GroundAction& action) const {
    std::optional<GroundLiteral> sensed;
    for (const GroundEffect& effect : action.effects) {
      for (const GroundChange& change : effect.changes) {
        if (change.kind != GroundChange::Kind::kSense) continue;
        const Formula& formula = task_.formulas[change.formula.index()];
        if (!effect.condition.IsTrue()) Fail("conditions of sensing");
        if (sensed) Fail("actions that sense several things");
        if (formula.bound || formula.literals.size() > 1) Fail("Kw of conjunctions or intervals");
        sensed = formula.literals.front();
      }
    }
    return sensed;
  }

  std::string WriteProblem() {
    place_ = task_.goal_place;
    const bool is_sensed_at_first =
        !task_.initial.sensed.empty() || !task_.initial.values_sensed.empty();
    if (is_sensed_at_first) Fail("Kw and Kv in init");
    std::string text = fmt::format("(define (problem {}) (:domain {})\n (:init\n", name_, name_);
    std::vector<bool> is_stated(task_.atoms.size(), false);
    for (const GroundLiteral& literal : task_.initial.known) {
      is_stated[literal.atom.index()] = true;
      if (literal.is_positive) text += fmt::format("  {}\n", LiteralText(literal));
    }
    RequireExclusive(is_stated);
    for (std::size_t a = 0; a < task_.atoms.size(); ++a) {
      if (!is_stated[a]) text += fmt::format("  (unknown ({}))\n", atoms_[a]);
    }
    for (const InitialRelation& relation : task_.initial.relations) {
      text += relation.is_inclusive ? "  (or" : "  (oneof";
      for (const GroundLiteral& literal : relation.literals)
        text += fmt::format(" {}", LiteralText(literal));
      text += ")\n";
    }
    return text + fmt::format(" )\n (:goal {}))\n", QueryText(task_.goal));
  }

  // In PDDL the open values of one function are separate atoms. The initial state must have a
  // `oneof` of exactly these atoms, because only such a `oneof` says that the values exclude each
  // other.
  void RequireExclusive(const std::vector<bool>& is_stated) const {
    for (const GroundFunction& function : task_.functions) {
      std::vector<GroundLiteral> open;
      for (const AtomId value : function.values) {
        if (!is_stated[value.index()]) open.push_back({value, true});
      }
      const auto are_all = [&](const InitialRelation& relation) {
        return !relation.is_inclusive && std::ranges::is_permutation(relation.literals, open);
      };
      if (open.size() > 1 && std::ranges::none_of(task_.initial.relations, are_all)) {
        Fail(fmt::format("functions with several values or none, like {}", function.text));
      }
    }
  }

  const GroundTask& task_;
  std::string name_;
  FilePlace place_;                 // the place of the element that is being written
  std::vector<std::string> atoms_;  // the names of the atoms
  std::vector<bool> tells_false_;   // by atom: true if the task distinguishes false from unknown
};

}  // namespace

PddlFiles ToPddl(const GroundTask& task, const std::string& name) {
  return PddlWriter(task, name).Write();
}

}  // namespace assay::contingent
