#include "planner/contingent/pddl_text.h"

#include <fmt/format.h>

#include <optional>
#include <set>

namespace assay::contingent {
namespace {

// "at(cup) = table" becomes at-cup-table.
std::string NameOf(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const bool is_word = ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') ||
                         ('0' <= c && c <= '9') || c == '_' || c == '-';
    if (is_word) {
      name += 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    } else if (!name.empty() && name.back() != '-') {
      name += '-';
    }
  }
  while (name.ends_with('-')) name.pop_back();
  return name;
}

class Writer {
 public:
  Writer(const GroundTask& task, const std::string& name, const FilePlace& place)
      : task_(task), name_(NameOf(name)), place_(place) {
    std::set<std::string> taken;
    for (const std::string& atom : task.atoms) atoms_.push_back(Unique(NameOf(atom), taken));
  }

  PddlFiles Write() {
    if (!task_.updates.empty()) Fail("update rules");
    return {WriteDomain(), WriteProblem()};
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw InputError(place_, fmt::format("PDDL has no {}", what),
                     "facts, functions of objects, Kw of single atoms and Kx");
  }

  static std::string Unique(const std::string& name, std::set<std::string>& taken) {
    std::string unique = name;
    for (int n = 2; !taken.insert(unique).second; ++n) unique = fmt::format("{}-{}", name, n);
    return unique;
  }

  std::string LiteralText(const GroundLiteral& literal) const {
    const std::string atom = fmt::format("({})", atoms_[literal.atom.index()]);
    return literal.is_positive ? atom : fmt::format("(not {})", atom);
  }

  // Not known, sensed: what PDDL does not ask is left out.
  std::string QueryText(const GroundQuery& query) const {
    switch (query.kind) {
      case GroundQuery::Kind::kKnown:
        return LiteralText(query.literal);
      case GroundQuery::Kind::kNot:
        return "(and)";
      case GroundQuery::Kind::kSensed:
      case GroundQuery::Kind::kValueSensed:
        return "";
      case GroundQuery::Kind::kBoundKnown:
        Fail("intervals");
      case GroundQuery::Kind::kAnd:
      case GroundQuery::Kind::kOr:
        break;
    }
    std::string text = query.kind == GroundQuery::Kind::kAnd ? "(and" : "(or";
    for (const GroundQuery& operand : query.operands) {
      const std::string of_operand = QueryText(operand);
      if (!of_operand.empty() && of_operand != "(and)") text += fmt::format(" {}", of_operand);
    }
    return text + ")";
  }

  std::string WriteDomain() const {
    std::string text = fmt::format("(define (domain {})\n (:predicates", name_);
    for (const std::string& atom : atoms_) text += fmt::format(" ({})", atom);
    text += ")\n";
    std::set<std::string> taken;
    for (const GroundAction& action : task_.actions) text += ActionText(action, taken);
    return text + ")\n";
  }

  std::string ActionText(const GroundAction& action, std::set<std::string>& taken) const {
    for (const FunctionId value : action.run_time_values) {
      if (!value.IsNone()) Fail("run-time variables");
    }
    std::string text = fmt::format(" (:action {}\n", Unique(NameOf(TextOf(action)), taken));
    const std::string precondition = QueryText(action.precondition);
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
        if (sensed) Fail("actions that sense several things");
        if (formula.bound || formula.literals.size() > 1) Fail("Kw of conjunctions or intervals");
        sensed = formula.literals.front();
      }
    }
    return sensed;
  }

  std::string WriteProblem() const {
    std::string text = fmt::format("(define (problem {}) (:domain {})\n (:init\n", name_, name_);
    std::vector<bool> is_told(task_.atoms.size(), false);
    for (const GroundLiteral& literal : task_.initial.known) {
      is_told[literal.atom.index()] = true;
      if (literal.is_positive) text += fmt::format("  {}\n", LiteralText(literal));
    }
    for (std::size_t a = 0; a < task_.atoms.size(); ++a) {
      if (!is_told[a]) text += fmt::format("  (unknown ({}))\n", atoms_[a]);
    }
    for (const InitialRelation& relation : task_.initial.relations) {
      text += relation.is_inclusive ? "  (or" : "  (oneof";
      for (const GroundLiteral& literal : relation.literals)
        text += fmt::format(" {}", LiteralText(literal));
      text += ")\n";
    }
    return text + fmt::format(" )\n (:goal {}))\n", QueryText(task_.goal));
  }

  const GroundTask& task_;
  std::string name_;
  FilePlace place_;
  std::vector<std::string> atoms_;  // their names
};

}  // namespace

PddlFiles ToPddl(const GroundTask& task, const std::string& name, const FilePlace& place) {
  return Writer(task, name, place).Write();
}

}  // namespace assay::contingent
