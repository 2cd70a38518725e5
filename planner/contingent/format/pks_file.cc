#include "planner/contingent/format/pks_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "planner/base/document/input_file.h"
#include "planner/contingent/format/pks_lexer.h"

namespace assay::contingent {
namespace {

// A recursive descent parser with one member function for each rule of the grammar.
class Parser {
 public:
  Parser(const std::string& text, const std::string& file)
      : file_(file), tokens_(Tokens(text, file)) {}

  Domain ReadDomain() {
    Domain domain;
    domain.file = file_;
    domain.name = TitleAfter("domain").text;
    while (Peek().kind != Token::Kind::kEnd) ReadDomainSection(domain);
    return domain;
  }

  Problem ReadProblem() {
    Problem problem;
    problem.file = file_;
    problem.name = TitleAfter("problem").text;
    const Token domain = TitleAfter("domain");
    problem.domain = domain.text;
    problem.domain_place = domain.place;
    while (Peek().kind != Token::Kind::kEnd) ReadProblemSection(problem);
    if (!has_goal_) FailAtNext("a goal");
    return problem;
  }

 private:
  // ---- Tokens

  const Token& Peek(std::size_t ahead = 0) const {
    return tokens_[std::min(at_ + ahead, tokens_.size() - 1)];
  }
  Token Take() { return at_ + 1 < tokens_.size() ? tokens_[at_++] : tokens_.back(); }

  bool TakeIf(std::string_view sign) {
    const bool is_there = Peek().Is(sign);
    if (is_there) Take();
    return is_there;
  }

  bool TakeWordIf(std::string_view word) {
    const bool is_there = Peek().IsName(word);
    if (is_there) Take();
    return is_there;
  }

  [[noreturn]] void FailAtNext(const std::string& allowed) const {
    const Token& next = Peek();
    Fail(next.place,
         next.kind == Token::Kind::kEnd ? "the file ends here"
                                        : fmt::format("unexpected '{}'", next.text),
         allowed);
  }

  [[noreturn]] void Fail(Place place, const std::string& what, const std::string& allowed) const {
    throw InputError({file_, place.line, place.column}, what, allowed);
  }

  void Expect(std::string_view sign) {
    if (!TakeIf(sign)) FailAtNext(fmt::format("'{}'", sign));
  }

  Token ExpectName(const std::string& what) {
    if (Peek().kind != Token::Kind::kName) FailAtNext(what);
    return Take();
  }

  // Counts how deeply rules are nested, so that no file overflows the stack.
  class Nesting {
   public:
    explicit Nesting(Parser& parser) : parser_(parser) {
      if (++parser_.depth_ > kDeepestNesting) {
        parser_.Fail(parser_.Peek().place, "nested too deeply",
                     fmt::format("{} levels", kDeepestNesting));
      }
    }
    ~Nesting() { --parser_.depth_; }
    Nesting(const Nesting&) = delete;
    Nesting& operator=(const Nesting&) = delete;

   private:
    Parser& parser_;
  };

  // ---- Sections

  Token TitleAfter(const std::string& keyword) {
    if (!TakeWordIf(keyword)) FailAtNext(fmt::format("'{} NAME'", keyword));
    return ExpectName("a name");
  }

  // Marks the section as read, and fails if it was read before.
  void RequireOnce(bool& was_there, const Token& section) const {
    if (was_there) {
      Fail(section.place, fmt::format("'{}:' a second time", section.text),
           fmt::format("one {}:", section.text));
    }
    was_there = true;
  }

  void ReadDomainSection(Domain& domain) {
    if (TakeWordIf("action")) {
      domain.actions.push_back(ReadAction());
      return;
    }
    static const std::string kSections =
        "types:, predicates:, functions:, externs:, constants:, action or updates:";
    const Token section = Peek().kind == Token::Kind::kName && Peek(1).Is(":") ? Take() : Token{};
    if (section.text.empty()) FailAtNext(kSections);
    Expect(":");
    if (section.text == "types") {
      Append(domain.types, TypedNames(false));
    } else if (section.text == "predicates") {
      Append(domain.predicates, Symbols(false));
    } else if (section.text == "functions") {
      Append(domain.functions, Symbols(true));
    } else if (section.text == "externs") {
      Append(domain.externs, Symbols(false));
    } else if (section.text == "constants") {
      Append(domain.constants, TypedNames(false));
    } else if (section.text == "updates") {
      Append(domain.updates, ReadEffects());
    } else {
      Fail(section.place, fmt::format("unknown section '{}'", section.text), kSections);
    }
  }

  void ReadProblemSection(Problem& problem) {
    static const std::string kSections = "objects:, externs:, init: or goal:";
    const Token section = Peek().kind == Token::Kind::kName && Peek(1).Is(":") ? Take() : Token{};
    if (section.text.empty()) FailAtNext(kSections);
    Expect(":");
    if (section.text == "objects") {
      Append(problem.objects, TypedNames(false));
    } else if (section.text == "externs") {
      if (!BeginsSection()) Append(problem.extern_facts, ExternFacts());
    } else if (section.text == "init") {
      if (!BeginsSection()) Append(problem.init, Changes());
    } else if (section.text == "goal") {
      RequireOnce(has_goal_, section);
      problem.goal = ReadQuery();
    } else {
      Fail(section.place, fmt::format("unknown section '{}'", section.text), kSections);
    }
  }

  std::vector<Literal> ExternFacts() {
    std::vector<Literal> facts;
    do {
      Literal fact = ReadLiteral();
      if (fact.relation != Relation::kPredicate || !fact.is_positive) {
        Fail(fact.place, "not an extern with its arguments", "what is true, as reachable(a, b)");
      }
      fact.relation = Relation::kExtern;
      facts.push_back(std::move(fact));
    } while (TakeIf(","));
    return facts;
  }

  bool BeginsSection() const {
    return Peek().kind == Token::Kind::kEnd || Peek().IsName("action") ||
           (Peek().kind == Token::Kind::kName && Peek(1).Is(":"));
  }

  template <class T>
  static void Append(std::vector<T>& to, std::vector<T> from) {
    std::move(from.begin(), from.end(), std::back_inserter(to));
  }

  // names = { name { "," name } [ ":" type ] [ "," | ";" ] }: a type applies to all names before it
  // that have none yet.
  std::vector<TypedName> TypedNames(bool are_variables) {
    const auto kind = are_variables ? Token::Kind::kVariable : Token::Kind::kName;
    std::vector<TypedName> names;
    std::size_t untyped = 0;
    while (Peek().kind == kind && !(IsSectionName() && Peek(1).Is(":"))) {
      const Token name = Take();
      names.push_back({.name = name.text, .type = "", .place = name.place});
      if (TakeIf(":")) {
        const std::string type = ExpectName("a type").text;
        for (; untyped < names.size(); ++untyped) names[untyped].type = type;
      }
      if (TakeIf(";")) {
        untyped = names.size();
      } else if (!TakeIf(",")) {
        break;
      }
    }
    return names;
  }

  bool IsSectionName() const {
    return Peek().kind == Token::Kind::kName && std::ranges::count(kPksSections, Peek().text) > 0;
  }

  std::vector<Symbol> Symbols(bool are_functions) {
    std::vector<Symbol> symbols;
    while (!BeginsSection() || (are_functions && !IsSectionName() && Peek(1).Is(":"))) {
      const Token name = ExpectName("a name");
      Symbol symbol{.name = name.text, .parameters = {}, .range = "", .place = name.place};
      if (TakeIf("(")) {
        symbol.parameters = SymbolParameters();
        Expect(")");
      }
      if (are_functions) {
        Expect(":");
        symbol.range = ExpectName("a type, or number").text;
      }
      symbols.push_back(std::move(symbol));
      if (!TakeIf(",") && !TakeIf(";")) break;
    }
    return symbols;
  }

  // Reads the parameters of a symbol: either types alone, or variables with their types.
  std::vector<TypedName> SymbolParameters() {
    if (Peek().kind == Token::Kind::kVariable) return TypedNames(true);
    std::vector<TypedName> parameters;
    if (Peek().Is(")")) return parameters;
    do {
      const Token type = ExpectName("a type");
      parameters.push_back({.name = "", .type = type.text, .place = type.place});
    } while (TakeIf(","));
    return parameters;
  }

  Action ReadAction() {
    const Token name = ExpectName("the action's name");
    Action action;
    action.name = name.text;
    action.place = name.place;
    if (TakeIf("(")) {
      action.parameters = TypedNames(true);
      Expect(")");
    }
    bool has_precondition = false;
    bool has_effects = false;
    while (Peek(1).Is(":") && (Peek().IsName("preconds") || Peek().IsName("effects"))) {
      const Token section = Take();
      const bool is_precondition = section.text == "preconds";
      RequireOnce(is_precondition ? has_precondition : has_effects, section);
      Expect(":");
      if (is_precondition) {
        action.precondition = ReadQuery();
      } else {
        Append(action.effects, ReadEffects());
      }
    }
    return action;
  }

  // ---- Effects

  // effects = effect { ";" effect }
  std::vector<Effect> ReadEffects() {
    std::vector<Effect> effects;
    do {
      ReadEffect(effects);
    } while (TakeIf(";"));
    return effects;
  }

  bool BeginsChange() const {
    return (Peek().IsName("add") || Peek().IsName("del")) && Peek(1).Is("(");
  }

  // effect = [ "forall" "(" variables ")" ] [ query "=>" ] changes; after a comma another query may
  // begin another effect.
  void ReadEffect(std::vector<Effect>& effects) {
    do {
      Effect effect;
      effect.place = Peek().place;
      if (TakeWordIf("forall")) {
        Expect("(");
        effect.variables = TypedNames(true);
        Expect(")");
      }
      if (!BeginsChange()) {
        effect.condition = ReadQuery();
        Expect("=>");
      }
      effect.changes = Changes();
      effects.push_back(std::move(effect));
    } while (!Peek().Is(";") && !BeginsSection() && was_comma_);
  }

  // Reads a list of changes. Stops after a comma that is not followed by a change.
  std::vector<Change> Changes() {
    std::vector<Change> changes;
    do {
      was_comma_ = !changes.empty();
      if (!changes.empty() && !BeginsChange()) return changes;
      changes.push_back(ReadChange());
      was_comma_ = false;
    } while (TakeIf(","));
    return changes;
  }

  Change ReadChange() {
    if (!BeginsChange()) FailAtNext("add(STORE, ...) or del(STORE, ...)");
    Change change;
    change.place = Peek().place;
    change.is_addition = Take().text == "add";
    Expect("(");
    const Token store = ExpectName("Kf, Kw, Kv, Kx or LCW");
    Expect(",");
    if (store.text == "Kf") {
      change.store = Store::kFacts;
      change.literals.push_back(ReadLiteral());
    } else if (store.text == "Kw") {
      change.store = Store::kWhether;
      change.literals = Conjunction();
    } else if (store.text == "Kv") {
      change.store = Store::kValues;
      change.terms.push_back(ReadTerm());
      change.within = ReadWithin();
    } else if (store.text == "Kx") {
      change.store = Store::kExclusive;
      ReadAlternatives(change);
    } else if (store.text == "LCW") {
      change.store = Store::kClosed;
      change.literals.push_back(ReadLiteral());
    } else {
      Fail(store.place, fmt::format("unknown store '{}'", store.text), "Kf, Kw, Kv, Kx or LCW");
    }
    Expect(")");
    return change;
  }

  // alternatives = literal { "|" literal } | "some" "(" literal { "|" literal } ")"
  void ReadAlternatives(Change& change) {
    change.is_inclusive = Peek(1).Is("(") && TakeWordIf("some");
    if (change.is_inclusive) Expect("(");
    do {
      change.literals.push_back(ReadLiteral());
    } while (TakeIf("|"));
    if (change.is_inclusive) Expect(")");
  }

  // ---- Queries

  Query ReadQuery() { return ReadSequence("|", Query::Kind::kOr); }

  Query ReadSequence(std::string_view sign, Query::Kind kind) {
    const Nesting nesting(*this);
    const auto operand = [&] {
      return kind == Query::Kind::kOr ? ReadSequence("&", Query::Kind::kAnd) : ReadUnary();
    };
    Query first = operand();
    if (!Peek().Is(sign)) return first;
    Query all;
    all.kind = kind;
    all.place = first.place;
    all.operands.push_back(std::move(first));
    while (TakeIf(sign)) all.operands.push_back(operand());
    return all;
  }

  Query ReadUnary() {
    const Nesting nesting(*this);
    const Place place = Peek().place;
    if (TakeIf("!") || TakeIf("-") || TakeWordIf("not")) {
      Query negation;
      negation.kind = Query::Kind::kNot;
      negation.place = place;
      negation.operands.push_back(ReadUnary());
      return negation;
    }
    if (TakeIf("(")) {
      Query inner = ReadQuery();
      Expect(")");
      return inner;
    }
    return ReadModal();
  }

  Query ReadModal() {
    Query query;
    query.place = Peek().place;
    const std::string word = Peek().kind == Token::Kind::kName ? Peek().text : "";
    if (word == "forallK" || word == "existsK") {
      Take();
      query.kind = word == "forallK" ? Query::Kind::kForAll : Query::Kind::kExists;
      Expect("(");
      query.variables = TypedNames(true);
      Expect(")");
      query.operands.push_back(ReadUnary());
      return query;
    }
    if (word == "true") {
      Take();
      return query;
    }
    if (word != "K" && word != "Kw" && word != "Kv") {
      FailAtNext("K(...), Kw(...), Kv(...), forallK, existsK, true, a negation or a parenthesis");
    }
    Take();
    Expect("(");
    if (word == "Kv") {
      query.kind = Query::Kind::kValueKnown;
      query.terms.push_back(ReadTerm());
      query.within = ReadWithin();
    } else {
      query.kind = word == "K" ? Query::Kind::kKnown : Query::Kind::kKnownWhether;
      query.literals = Conjunction();
    }
    Expect(")");
    return query;
  }

  // ---- Literals and terms

  std::vector<Literal> Conjunction() {
    std::vector<Literal> literals;
    do {
      literals.push_back(ReadLiteral());
    } while (TakeIf("&"));
    return literals;
  }

  static std::optional<std::pair<Relation, bool>> RelationOf(const Token& token) {
    if (token.kind != Token::Kind::kSign) return std::nullopt;
    if (token.text == "=") return {{Relation::kEqual, true}};
    if (token.text == "!=") return {{Relation::kEqual, false}};
    if (token.text == "<") return {{Relation::kLess, true}};
    if (token.text == "<=") return {{Relation::kLessOrEqual, true}};
    if (token.text == ">") return {{Relation::kGreater, true}};
    if (token.text == ">=") return {{Relation::kGreaterOrEqual, true}};
    return std::nullopt;
  }

  Literal ReadLiteral() {
    const Nesting nesting(*this);
    Literal literal;
    literal.place = Peek().place;
    if (TakeIf("!") || TakeIf("-") || TakeWordIf("not")) {
      literal = ReadLiteral();
      literal.is_positive = !literal.is_positive;
      return literal;
    }
    if (TakeIf("(")) {
      literal = ReadLiteral();
      Expect(")");
      return literal;
    }
    const bool is_extern = Peek(1).Is("(") && TakeWordIf("extern");
    if (is_extern) Expect("(");
    Term left = ReadTerm();
    if (const auto relation = RelationOf(Peek()); relation && !is_extern) {
      Take();
      literal.relation = relation->first;
      literal.is_positive = relation->second;
      literal.arguments.push_back(std::move(left));
      literal.arguments.push_back(ReadSum());
      return literal;
    }
    if (left.kind != Term::Kind::kConstant && left.kind != Term::Kind::kFunction) {
      FailAtNext("'=', '!=', '<', '<=', '>' or '>='");
    }
    literal.relation = is_extern ? Relation::kExtern : Relation::kPredicate;
    literal.predicate = left.name;
    literal.arguments = std::move(left.arguments);
    if (is_extern) Expect(")");
    return literal;
  }

  // sum = term [ ("+" | "-") term ]
  Term ReadSum() {
    Term left = ReadTerm();
    if (!Peek().Is("+") && !Peek().Is("-")) return left;
    Term sum;
    sum.place = Peek().place;
    sum.kind = Take().text == "+" ? Term::Kind::kSum : Term::Kind::kDifference;
    sum.arguments.push_back(std::move(left));
    sum.arguments.push_back(ReadTerm());
    return sum;
  }

  Term ReadTerm() {
    const Nesting nesting(*this);
    Term term;
    term.place = Peek().place;
    if (Peek().kind == Token::Kind::kVariable) {
      term.kind = Term::Kind::kVariable;
      term.name = Take().text;
      return term;
    }
    if (Peek().kind == Token::Kind::kNumber || Peek().Is("-") || Peek().Is("[")) {
      term.kind = Term::Kind::kNumber;
      term.value = ReadInterval();
      return term;
    }
    term.name = ExpectName("a name, a ?variable, a number or an interval").text;
    if (TakeIf("(")) {
      term.kind = Term::Kind::kFunction;
      if (!Peek().Is(")")) {
        do {
          term.arguments.push_back(ReadTerm());
        } while (TakeIf(","));
      }
      Expect(")");
    }
    return term;
  }

  std::optional<double> ReadWithin() {
    if (!TakeWordIf("within")) return std::nullopt;
    const Place place = Peek().place;
    const double within = ReadNumber();
    if (within < 0) Fail(place, fmt::format("an error of {}", within), "0 or more");
    return within;
  }

  Interval ReadInterval() {
    if (!TakeIf("[")) {
      const double number = ReadNumber();
      return {number, number};
    }
    const Place place = Peek().place;
    Interval interval;
    interval.low = ReadNumber();
    Expect(",");
    interval.high = ReadNumber();
    Expect("]");
    if (interval.low > interval.high) {
      Fail(place, fmt::format("the interval [{}, {}] is empty", interval.low, interval.high),
           "a lower end that is not above the upper one");
    }
    return interval;
  }

  double ReadNumber() {
    const bool is_negative = TakeIf("-");
    if (Peek().kind != Token::Kind::kNumber) FailAtNext("a number");
    const Token token = Take();
    double number = 0;
    const char* const end = token.text.data() + token.text.size();
    const auto [stop, error] = std::from_chars(token.text.data(), end, number);
    if (error != std::errc() || stop != end || !std::isfinite(number)) {
      Fail(token.place, fmt::format("'{}' is no number", token.text), "a finite number");
    }
    return is_negative ? -number : number;
  }

  std::string file_;
  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  int depth_ = 0;
  bool has_goal_ = false;
  bool was_comma_ = false;  // true if a comma precedes the next token in a list of changes
};

}  // namespace

Domain ReadPksDomain(const std::string& text, const std::string& file) {
  return Parser(text, file).ReadDomain();
}

Problem ReadPksProblem(const std::string& text, const std::string& file) {
  return Parser(text, file).ReadProblem();
}

std::string TextOfFile(const std::filesystem::path& file) {
  std::string text = ReadInput(file, "a file with text");
  RequireText(text, file.string());
  return text;
}

}  // namespace assay::contingent
