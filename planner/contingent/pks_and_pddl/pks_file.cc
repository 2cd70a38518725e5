#include "planner/contingent/pks_and_pddl/pks_file.h"

#include <fmt/format.h>

#include <iterator>
#include <utility>

#include "planner/base/input_files/input_file.h"
#include "planner/contingent/pks_and_pddl/pks_effects.h"
#include "planner/contingent/pks_and_pddl/pks_formula.h"
#include "planner/contingent/pks_and_pddl/pks_tokens.h"

namespace assay::contingent {
namespace {

template <class T>
void Append(std::vector<T>& to, std::vector<T> from) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

// Reads the title and the sections of a file.
class PksReader {
 public:
  PksReader(const std::string& text, const std::string& file) : tokens_(text, file) {}

  Domain ReadDomain() {
    Domain domain;
    domain.file = tokens_.file();
    domain.name = TitleAfter("domain").text;
    while (tokens_.Peek().kind != Token::Kind::kEnd) ReadDomainSection(domain);
    return domain;
  }

  Problem ReadProblem() {
    Problem problem;
    problem.file = tokens_.file();
    problem.name = TitleAfter("problem").text;
    const Token domain = TitleAfter("domain");
    problem.domain = domain.text;
    problem.domain_place = domain.place;
    while (tokens_.Peek().kind != Token::Kind::kEnd) ReadProblemSection(problem);
    if (!has_goal_) tokens_.FailAtNext("a goal");
    return problem;
  }

 private:
  Token TitleAfter(const std::string& keyword) {
    if (!tokens_.TakeWordIf(keyword)) tokens_.FailAtNext(fmt::format("'{} NAME'", keyword));
    return tokens_.ExpectName("a name");
  }

  // Takes the name of a section and its colon.
  Token TakeSection(const std::string& allowed) {
    if (tokens_.Peek().kind != Token::Kind::kName || !tokens_.Peek(1).Is(":")) {
      tokens_.FailAtNext(allowed);
    }
    Token section = tokens_.Take();
    tokens_.Expect(":");
    return section;
  }

  [[noreturn]] void FailAsUnknown(const Token& section, const std::string& allowed) const {
    tokens_.Fail(section.place, fmt::format("unknown section '{}'", section.text), allowed);
  }

  // Marks the section as read, and fails if it was read before.
  void RequireOnce(bool& was_there, const Token& section) const {
    if (was_there) {
      tokens_.Fail(section.place, fmt::format("'{}:' a second time", section.text),
                   fmt::format("one {}:", section.text));
    }
    was_there = true;
  }

  void ReadDomainSection(Domain& domain) {
    if (tokens_.TakeWordIf("action")) {
      domain.actions.push_back(ReadAction());
      return;
    }
    static const std::string kSections =
        "types:, predicates:, functions:, externs:, constants:, action or updates:";
    const Token section = TakeSection(kSections);
    if (section.text == "types") {
      Append(domain.types, tokens_.TypedNames(Token::Kind::kName));
    } else if (section.text == "predicates") {
      Append(domain.predicates, Symbols(false));
    } else if (section.text == "functions") {
      Append(domain.functions, Symbols(true));
    } else if (section.text == "externs") {
      Append(domain.externs, Symbols(false));
    } else if (section.text == "constants") {
      Append(domain.constants, tokens_.TypedNames(Token::Kind::kName));
    } else if (section.text == "updates") {
      Append(domain.updates, ReadEffects(tokens_));
    } else {
      FailAsUnknown(section, kSections);
    }
  }

  void ReadProblemSection(Problem& problem) {
    static const std::string kSections = "objects:, externs:, init: or goal:";
    const Token section = TakeSection(kSections);
    if (section.text == "objects") {
      Append(problem.objects, tokens_.TypedNames(Token::Kind::kName));
    } else if (section.text == "externs") {
      if (!tokens_.BeginsSection()) Append(problem.extern_facts, ExternFacts());
    } else if (section.text == "init") {
      if (!tokens_.BeginsSection()) Append(problem.init, ReadChanges(tokens_));
    } else if (section.text == "goal") {
      RequireOnce(has_goal_, section);
      problem.goal = ReadQuery(tokens_);
    } else {
      FailAsUnknown(section, kSections);
    }
  }

  std::vector<Literal> ExternFacts() {
    return tokens_.List(",", [&] {
      Literal fact = ReadLiteral(tokens_);
      if (fact.relation != Relation::kPredicate || !fact.is_positive) {
        tokens_.Fail(fact.place, "not an extern with its arguments",
                     "what is true, as reachable(a, b)");
      }
      fact.relation = Relation::kExtern;
      return fact;
    });
  }

  std::vector<Symbol> Symbols(bool are_functions) {
    std::vector<Symbol> symbols;
    while (!tokens_.BeginsSection() ||
           (are_functions && !tokens_.IsSectionName() && tokens_.Peek(1).Is(":"))) {
      const Token name = tokens_.ExpectName("a name");
      Symbol symbol{.name = name.text, .parameters = {}, .range = "", .place = name.place};
      if (tokens_.TakeIf("(")) {
        symbol.parameters = SymbolParameters();
        tokens_.Expect(")");
      }
      if (are_functions) {
        tokens_.Expect(":");
        symbol.range = tokens_.ExpectName("a type, or number").text;
      }
      symbols.push_back(std::move(symbol));
      if (!tokens_.TakeIf(",") && !tokens_.TakeIf(";")) break;
    }
    return symbols;
  }

  // Reads the parameters of a symbol: either types alone, or variables with their types.
  std::vector<TypedName> SymbolParameters() {
    if (tokens_.Peek().kind == Token::Kind::kVariable) {
      return tokens_.TypedNames(Token::Kind::kVariable);
    }
    if (tokens_.Peek().Is(")")) return {};
    return tokens_.List(",", [&] {
      const Token type = tokens_.ExpectName("a type");
      return TypedName{.name = "", .type = type.text, .place = type.place};
    });
  }

  Action ReadAction() {
    const Token name = tokens_.ExpectName("the action's name");
    Action action;
    action.name = name.text;
    action.place = name.place;
    if (tokens_.Peek().Is("(")) action.parameters = tokens_.Variables();
    bool has_precondition = false;
    bool has_effects = false;
    while (tokens_.Peek(1).Is(":") &&
           (tokens_.Peek().IsName("preconds") || tokens_.Peek().IsName("effects"))) {
      const Token section = tokens_.Take();
      const bool is_precondition = section.text == "preconds";
      RequireOnce(is_precondition ? has_precondition : has_effects, section);
      tokens_.Expect(":");
      if (is_precondition) {
        action.precondition = ReadQuery(tokens_);
      } else {
        Append(action.effects, ReadEffects(tokens_));
      }
    }
    return action;
  }

  PksTokens tokens_;
  bool has_goal_ = false;
};

}  // namespace

Domain ReadPksDomain(const std::string& text, const std::string& file) {
  return PksReader(text, file).ReadDomain();
}

Problem ReadPksProblem(const std::string& text, const std::string& file) {
  return PksReader(text, file).ReadProblem();
}

std::string TextOfFile(const std::filesystem::path& file) {
  std::string text = ReadInput(file, "a file with text");
  RequireText(text, file.string());
  return text;
}

}  // namespace assay::contingent
