#include "planner/contingent/pks_and_pddl/pddl_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "planner/base/input_files/document.h"
#include "planner/base/input_files/nearest_name.h"
#include "planner/contingent/pks_and_pddl/pddl_formulas.h"
#include "planner/contingent/pks_and_pddl/s_expression.h"

namespace assay::contingent {
namespace {

class PddlReader : private PddlFormulas {
 public:
  using PddlFormulas::PddlFormulas;

  Domain ReadDomain(const SExpression& whole) {
    Domain domain;
    domain.file = file();
    domain.name = TitleOf(whole, "domain");
    domain.types.push_back({.name = kPddlRootType});
    for (const SExpression& section : Rest(whole, 2)) ReadDomainSection(section, domain);
    // Some published domains have constants of types that they do not declare.
    for (const TypedName& constant : domain.constants) DeclareType(constant.type, domain);
    return domain;
  }

  static void DeclareType(const std::string& name, Domain& domain) {
    const bool is_declared = std::any_of(domain.types.begin(), domain.types.end(),
                                         [&](const TypedName& t) { return t.name == name; });
    if (!is_declared) domain.types.push_back({.name = name, .type = kPddlRootType});
  }

  Problem ReadProblem(const SExpression& whole, const Domain& domain) {
    Problem problem;
    problem.file = file();
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
        if (type.name != kPddlRootType) domain.types.push_back(std::move(type));
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

  // ---- Effects

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
