#include "planner/contingent/format/pddl_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <utility>

#include "planner/base/document/document.h"
#include "planner/base/document/nearest_name.h"
#include "planner/contingent/format/s_expression.h"

namespace assay::contingent {
namespace {

constexpr const char* kRootType = "object";

class PddlReader {
 public:
  explicit PddlReader(const std::string& file) : file_(file) {}

  Domain ReadDomain(const SExpression& whole) {
    Domain domain;
    domain.file = file_;
    domain.name = TitleOf(whole, "domain");
    domain.types.push_back({.name = kRootType});
    for (const SExpression& section : Rest(whole, 2)) ReadDomainSection(section, domain);
    // Some published domains have constants of types that they do not declare.
    for (const TypedName& constant : domain.constants) DeclareType(constant.type, domain);
    return domain;
  }

  static void DeclareType(const std::string& name, Domain& domain) {
    const bool is_declared = std::any_of(domain.types.begin(), domain.types.end(),
                                         [&](const TypedName& t) { return t.name == name; });
    if (!is_declared) domain.types.push_back({.name = name, .type = kRootType});
  }

  Problem ReadProblem(const SExpression& whole, const Domain& domain) {
    Problem problem;
    problem.file = file_;
    problem.name = TitleOf(whole, "problem");
    problem.domain = domain.name;
    for (const Symbol& predicate : domain.predicates) problem.init.push_back(Closed(predicate));
    for (const SExpression& section : Rest(whole, 2)) {
      if (section.BeginsWith(":domain")) {
        RequireDomain(Only(section), domain);
      } else {
        ReadProblemSection(section, problem);
      }
    }
    if (!has_goal_) Fail(whole, "a problem without a goal", "(:goal CONDITION)");
    return problem;
  }

 private:
  using Items = std::span<const SExpression>;

  [[noreturn]] void Fail(const SExpression& at, const std::string& what,
                         const std::string& allowed) const {
    throw InputError({file_, at.place.line, at.place.column}, what, allowed);
  }

  static Items Rest(const SExpression& list, std::size_t from) {
    return Items(list.items).subspan(std::min(from, list.items.size()));
  }

  const std::string& Word(const SExpression& e, const std::string& what) const {
    if (e.is_list) Fail(e, "a list", what);
    return e.word;
  }

  const SExpression& Only(const SExpression& list) const {
    if (list.items.size() != 2) {
      Fail(list, fmt::format("{} items", list.items.size()), "a word and one argument");
    }
    return list.items[1];
  }

  std::string TitleOf(const SExpression& whole, const std::string& kind) const {
    if (!whole.BeginsWith("define") || whole.items.size() < 2 || !whole.items[1].BeginsWith(kind)) {
      Fail(whole, "unknown form", fmt::format("(define ({} NAME) ...)", kind));
    }
    return Word(Only(whole.items[1]), "a name");
  }

  // ---- Sections

  void RequireOnce(bool was_there, const SExpression& section) const {
    if (was_there) {
      const std::string& name = section.is_list ? section.items[0].word : section.word;
      Fail(section, fmt::format("{} a second time", name), fmt::format("one {}", name));
    }
  }

  void ReadDomainSection(const SExpression& section, Domain& domain) {
    if (section.BeginsWith(":requirements")) return;
    if (section.BeginsWith(":types")) {
      for (TypedName& type : TypedNames(Rest(section, 1))) {
        if (type.name != kRootType) domain.types.push_back(std::move(type));
      }
    } else if (section.BeginsWith(":constants")) {
      RequireOnce(!domain.constants.empty(), section);
      domain.constants = TypedNames(Rest(section, 1));
    } else if (section.BeginsWith(":predicates")) {
      for (const SExpression& predicate : Rest(section, 1)) {
        if (predicate.items.empty()) Fail(predicate, "no predicate", "(NAME ?x - TYPE ...)");
        domain.predicates.push_back({.name = Word(predicate.items[0], "a name"),
                                     .parameters = TypedNames(Rest(predicate, 1)),
                                     .range = "",
                                     .place = predicate.place});
      }
    } else if (section.BeginsWith(":action")) {
      domain.actions.push_back(ReadAction(section));
    } else {
      Fail(section, "unknown section",
           ":requirements, :types, :constants, :predicates and :action");
    }
  }

  // Some published problems have a slip in the domain's name ("logistics_conf" for logistics_cont).
  void RequireDomain(const SExpression& name, const Domain& domain) const {
    const std::string& named = Word(name, "a name");
    if (NearestName(named, {domain.name}).empty()) {
      Fail(name, fmt::format("a problem of '{}'", named),
           fmt::format("problems of '{}'", domain.name));
    }
  }

  void ReadProblemSection(const SExpression& section, Problem& problem) {
    if (section.BeginsWith(":hidden") || section.BeginsWith(":requirements")) return;
    if (section.BeginsWith(":objects")) {
      RequireOnce(!problem.objects.empty(), section);
      problem.objects = TypedNames(Rest(section, 1));
    } else if (section.BeginsWith(":init")) {
      for (const SExpression& fact : Rest(section, 1)) ReadInit(fact, problem);
    } else if (section.BeginsWith(":goal")) {
      RequireOnce(has_goal_, section);
      has_goal_ = true;
      problem.goal = Condition(Only(section), true);
    } else {
      Fail(section, "unknown section", ":domain, :objects, :init and :goal");
    }
  }

  // Reads a list of names with types. In `a b - type c`, the untyped name c gets the root type.
  std::vector<TypedName> TypedNames(Items items) const {
    std::vector<TypedName> names;
    std::size_t untyped = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (items[i].Is("-")) {
        if (++i == items.size()) Fail(items[i - 1], "nothing follows '-'", "a type");
        for (; untyped < names.size(); ++untyped) names[untyped].type = Word(items[i], "a type");
      } else {
        std::string name = Word(items[i], "a name");
        if (name.starts_with('?')) name.erase(0, 1);
        names.push_back({.name = std::move(name), .type = kRootType, .place = items[i].place});
      }
    }
    return names;
  }

  Action ReadAction(const SExpression& section) {
    Action action;
    if (section.items.size() < 2) Fail(section, "an action without a name", "(:action NAME ...)");
    action.name = Word(section.items[1], "a name");
    action.place = section.items[1].place;
    std::set<std::string> keys;
    for (std::size_t i = 2; i < section.items.size(); i += 2) {
      const SExpression& key = section.items[i];
      if (i + 1 == section.items.size()) Fail(key, "nothing follows", "its value");
      const SExpression& value = section.items[i + 1];
      RequireOnce(!keys.insert(Word(key, "a key")).second, key);
      if (key.Is(":parameters")) {
        action.parameters = TypedNames(value.items);
      } else if (key.Is(":precondition")) {
        action.precondition = Condition(value, true);
      } else if (key.Is(":effect")) {
        Effect always;
        ReadEffect(value, always, action.effects);
        if (!always.changes.empty()) action.effects.insert(action.effects.begin(), always);
      } else if (key.Is(":observe")) {
        Effect sensing;
        sensing.changes.push_back(
            MakeChange(Store::kWhether, {ReadLiteral(value, "one atom")}, value));
        action.effects.push_back(std::move(sensing));
      } else {
        Fail(key, "unknown key", ":parameters, :precondition, :effect and :observe");
      }
    }
    return action;
  }

  // ---- Init

  static Change MakeChange(Store store, std::vector<Literal> literals, const SExpression& at) {
    Change change;
    change.store = store;
    change.literals = std::move(literals);
    change.place = at.place;
    return change;
  }

  static Change Closed(const Symbol& predicate) {
    Change change;
    change.store = Store::kClosed;
    Literal literal;
    literal.predicate = predicate.name;
    for (std::size_t i = 0; i < predicate.parameters.size(); ++i) {
      Term variable;
      variable.kind = Term::Kind::kVariable;
      variable.name = fmt::format("x{}", i + 1);
      change.variables.push_back({variable.name, predicate.parameters[i].type, predicate.place});
      literal.arguments.push_back(std::move(variable));
    }
    change.literals.push_back(std::move(literal));
    return change;
  }

  void ReadInit(const SExpression& fact, Problem& problem) {
    if (fact.BeginsWith("and")) {
      for (const SExpression& item : Rest(fact, 1)) ReadInit(item, problem);
    } else if (fact.BeginsWith("unknown")) {
      Change change = MakeChange(Store::kFacts, {ReadLiteral(Only(fact), "an atom")}, fact);
      change.is_addition = false;
      problem.init.push_back(std::move(change));
    } else if (fact.BeginsWith("oneof") || fact.BeginsWith("or")) {
      std::vector<Literal> literals;
      for (const SExpression& item : Rest(fact, 1)) {
        literals.push_back(ReadLiteral(item, "literals"));
      }
      if (literals.empty()) Fail(fact, "no alternatives", "one literal or more");
      Change change = MakeChange(Store::kExclusive, std::move(literals), fact);
      change.is_inclusive = fact.BeginsWith("or");
      problem.init.push_back(std::move(change));
    } else {
      problem.init.push_back(MakeChange(
          Store::kFacts, {ReadLiteral(fact, "literals, and, unknown, oneof and or")}, fact));
    }
  }

  // ---- Conditions and effects

  // Returns true for PDDL keywords that are outside the fragment or are not allowed in every place.
  static bool IsKeyword(const std::string& word) {
    static constexpr std::array kWords = {
        "and",   "or",     "oneof",    "unknown",  "when",     "forall",       "exists",
        "imply", "assign", "increase", "decrease", "scale-up", "probabilistic"};
    return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
  }

  // Reads a literal. `allowed` describes, for the message, what may stand there.
  Literal ReadLiteral(const SExpression& e, const std::string& allowed) const {
    if (e.BeginsWith("not")) {
      Literal literal = ReadLiteral(Only(e), allowed);
      literal.is_positive = !literal.is_positive;
      return literal;
    }
    if (e.items.empty()) Fail(e, "no literal", "(PREDICATE ...) or (not (PREDICATE ...))");
    Literal literal;
    literal.place = e.place;
    literal.predicate = Word(e.items[0], "a predicate");
    if (IsKeyword(literal.predicate)) {
      Fail(e,
           fmt::format("'{}' is a part of PDDL that this reader does not support",
                       literal.predicate),
           allowed);
    }
    if (literal.predicate == "=") literal.relation = Relation::kEqual;
    for (const SExpression& item : Rest(e, 1)) {
      Term term;
      term.name = Word(item, "a constant or a ?variable");
      term.place = item.place;
      if (term.name.starts_with('?')) {
        term.kind = Term::Kind::kVariable;
        term.name.erase(0, 1);
      }
      literal.arguments.push_back(std::move(term));
    }
    if (literal.relation == Relation::kEqual && literal.arguments.size() != 2) {
      Fail(e, fmt::format("{} sides", literal.arguments.size()), "(= A B)");
    }
    return literal;
  }

  // Returns the condition in negation normal form.
  Query Condition(const SExpression& e, bool is_positive) const {
    Query query;
    query.place = e.place;
    if (e.BeginsWith("not")) return Condition(Only(e), !is_positive);
    if ((e.is_list && e.items.empty()) || e.BeginsWith("and") || e.BeginsWith("or")) {
      const bool is_and = !e.BeginsWith("or");
      query.kind = is_and == is_positive ? Query::Kind::kAnd : Query::Kind::kOr;
      for (const SExpression& item : Rest(e, 1)) {
        query.operands.push_back(Condition(item, is_positive));
      }
      return query;
    }
    query.kind = Query::Kind::kKnown;
    query.literals.push_back(ReadLiteral(e, "literals, and, or and not"));
    query.literals.front().is_positive = is_positive;
    return query;
  }

  // Reads an effect. Changes without a further condition are added to `now`, and changes under a
  // further condition to `others`.
  void ReadEffect(const SExpression& e, Effect& now, std::vector<Effect>& others) {
    if ((e.is_list && e.items.empty()) || e.BeginsWith("and")) {
      for (const SExpression& item : Rest(e, 1)) ReadEffect(item, now, others);
    } else if (e.BeginsWith("when")) {
      if (e.items.size() != 3) Fail(e, "no condition with an effect", "(when CONDITION EFFECT)");
      Effect conditional;
      conditional.place = e.place;
      conditional.condition = Condition(e.items[1], true);
      if (e.items[2].BeginsWith("when")) Fail(e.items[2], "when in when", "one condition");
      ReadEffect(e.items[2], conditional, others);
      others.push_back(std::move(conditional));
    } else {
      now.changes.push_back(MakeChange(Store::kFacts, {ReadLiteral(e, "literals, and, when")}, e));
    }
  }

  const std::string& file_;
  bool has_goal_ = false;
};

}  // namespace

Domain ReadPddlDomain(const std::string& text, const std::string& file) {
  return PddlReader(file).ReadDomain(ReadSExpression(text, file));
}

Problem ReadPddlProblem(const std::string& text, const std::string& file, const Domain& domain) {
  return PddlReader(file).ReadProblem(ReadSExpression(text, file), domain);
}

}  // namespace assay::contingent
