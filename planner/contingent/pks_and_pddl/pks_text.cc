#include "planner/contingent/pks_and_pddl/pks_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "planner/contingent/grounding/ground_task.h"

namespace assay::contingent {
namespace {

template <class T, class Function>
std::string JoinedTexts(const std::vector<T>& items, const char* separator,
                        const Function& text_of) {
  std::vector<std::string> texts;
  for (const T& item : items) texts.push_back(text_of(item));
  return fmt::format("{}", fmt::join(texts, separator));
}

// In `a, b: t`, the type t applies to both names. After a name without a type, a semicolon
// therefore ends the list: otherwise the type of a later name would apply to this name, too.
std::string NamesText(const std::vector<TypedName>& names, const char* mark) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const TypedName& name = names[i];
    text += mark + name.name + (name.type.empty() ? "" : ": " + name.type);
    if (i + 1 < names.size()) text += name.type.empty() ? "; " : ", ";
  }
  return text;
}

std::string NumberText(const Interval& value) {
  return value.low == value.high ? fmt::format("{}", value.low)
                                 : fmt::format("[{}, {}]", value.low, value.high);
}

std::string TermText(const Term& term) {
  switch (term.kind) {
    case Term::Kind::kConstant:
      return term.name;
    case Term::Kind::kVariable:
      return fmt::format("?{}", term.name);
    case Term::Kind::kFunction:
      return fmt::format("{}({})", term.name, JoinedTexts(term.arguments, ", ", TermText));
    case Term::Kind::kNumber:
      return NumberText(term.value);
    case Term::Kind::kSum:
    case Term::Kind::kDifference:
      return fmt::format("{} {} {}", TermText(term.arguments[0]),
                         term.kind == Term::Kind::kSum ? "+" : "-", TermText(term.arguments[1]));
  }
  return "";
}

std::string ValueText(const Term& term, const std::optional<double>& within) {
  return within ? fmt::format("{} within {}", TermText(term), *within) : TermText(term);
}

std::string LiteralText(const Literal& literal) {
  const std::string arguments = JoinedTexts(literal.arguments, ", ", TermText);
  const char* const sign = literal.is_positive ? "" : "!";
  const std::string atom =
      literal.predicate + (arguments.empty() ? "" : fmt::format("({})", arguments));
  switch (literal.relation) {
    case Relation::kPredicate:
      return sign + atom;
    case Relation::kExtern:
      return fmt::format("{}extern({})", sign, atom);
    case Relation::kEqual:
    case Relation::kLess:
    case Relation::kLessOrEqual:
    case Relation::kGreater:
    case Relation::kGreaterOrEqual:
      break;
  }
  return fmt::format("{}({} {} {})", sign, TermText(literal.arguments[0]), TextOf(literal.relation),
                     TermText(literal.arguments[1]));
}

std::string QueryText(const Query& query) {
  switch (query.kind) {
    case Query::Kind::kAnd:
      if (query.operands.empty()) return "true";
      return fmt::format("({})", JoinedTexts(query.operands, " & ", QueryText));
    case Query::Kind::kOr:
      if (query.operands.empty()) return "!true";
      return fmt::format("({})", JoinedTexts(query.operands, " | ", QueryText));
    case Query::Kind::kNot:
      return fmt::format("!{}", QueryText(query.operands.front()));
    case Query::Kind::kKnown:
      return fmt::format("K({})", JoinedTexts(query.literals, " & ", LiteralText));
    case Query::Kind::kKnownWhether:
      return fmt::format("Kw({})", JoinedTexts(query.literals, " & ", LiteralText));
    case Query::Kind::kValueKnown:
      return fmt::format("Kv({})", ValueText(query.terms.front(), query.within));
    case Query::Kind::kForAll:
    case Query::Kind::kExists:
      return fmt::format("{} ({}) {}", query.kind == Query::Kind::kForAll ? "forallK" : "existsK",
                         NamesText(query.variables, "?"), QueryText(query.operands.front()));
  }
  return "";
}

std::string ChangeText(const Change& change) {
  const char* const verb = change.is_addition ? "add" : "del";
  switch (change.store) {
    case Store::kFacts:
      return fmt::format("{}(Kf, {})", verb, LiteralText(change.literals.front()));
    case Store::kWhether:
      return fmt::format("{}(Kw, {})", verb, JoinedTexts(change.literals, " & ", LiteralText));
    case Store::kValues:
      return fmt::format("{}(Kv, {})", verb, ValueText(change.terms.front(), change.within));
    case Store::kExclusive: {
      const std::string alternatives = JoinedTexts(change.literals, " | ", LiteralText);
      return fmt::format(
          "{}(Kx, {})", verb,
          change.is_inclusive ? fmt::format("some({})", alternatives) : alternatives);
    }
    case Store::kClosed:
      return fmt::format("{}(LCW, {})", verb, LiteralText(change.literals.front()));
  }
  return "";
}

std::string EffectText(const Effect& effect) {
  std::string text;
  if (!effect.variables.empty()) {
    text += fmt::format("forall ({}) ", NamesText(effect.variables, "?"));
  }
  const bool is_conditional =
      effect.condition.kind != Query::Kind::kAnd || !effect.condition.operands.empty();
  if (is_conditional) text += QueryText(effect.condition) + " => ";
  return text + JoinedTexts(effect.changes, ", ", ChangeText);
}

std::string ActionText(const Action& action) {
  std::string text =
      fmt::format("\naction {}({})\n", action.name, NamesText(action.parameters, "?"));
  text += fmt::format("  preconds: {}\n", QueryText(action.precondition));
  if (!action.effects.empty()) {
    text +=
        fmt::format("  effects: {}\n", JoinedTexts(action.effects, ";\n           ", EffectText));
  }
  return text;
}

std::string SymbolText(const Symbol& symbol) {
  std::string text = symbol.name;
  if (!symbol.parameters.empty()) {
    text += fmt::format(
        "({})", JoinedTexts(symbol.parameters, ", ", [](const TypedName& p) { return p.type; }));
  }
  return text + (symbol.range.empty() ? "" : ": " + symbol.range);
}

std::string Section(const char* title, const std::string& text) {
  return text.empty() ? "" : fmt::format("{}: {}\n", title, text);
}

}  // namespace

std::string TextOf(const Domain& domain) {
  std::string text = fmt::format("domain {}\n", domain.name);
  text += Section("types", NamesText(domain.types, ""));
  text += Section("predicates", JoinedTexts(domain.predicates, ", ", SymbolText));
  text += Section("functions", JoinedTexts(domain.functions, ", ", SymbolText));
  text += Section("externs", JoinedTexts(domain.externs, ", ", SymbolText));
  text += Section("constants", NamesText(domain.constants, ""));
  for (const Action& action : domain.actions) text += ActionText(action);
  return text + Section("\nupdates", JoinedTexts(domain.updates, ";\n  ", EffectText));
}

std::string TextOf(const Problem& problem) {
  std::string text = fmt::format("problem {}\ndomain {}\n", problem.name, problem.domain);
  text += Section("objects", NamesText(problem.objects, ""));
  text += Section("externs", JoinedTexts(problem.extern_facts, ", ", [](Literal fact) {
                    fact.relation = Relation::kPredicate;
                    return LiteralText(fact);
                  }));
  text += Section("init", JoinedTexts(problem.init, ",\n      ", ChangeText));
  return text + Section("goal", QueryText(problem.goal));
}

}  // namespace assay::contingent
