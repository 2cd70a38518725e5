#include "planner/contingent/grounding.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "planner/contingent/atom_table.h"
#include "planner/contingent/type_check.h"

namespace assay::contingent {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Ways to bind variables that are looked at, so that no file keeps the program busy for hours.
constexpr std::int64_t kMostBindings = 20'000'000;

// What a variable stands for: a constant, or the value of a function at run time.
struct Value {
  std::string text;
  FunctionId function;  // none for a constant
};

struct Binding {
  std::string variable;
  Value value;
};

Relation Complement(Relation relation) {
  switch (relation) {
    case Relation::kLess:
      return Relation::kGreaterOrEqual;
    case Relation::kLessOrEqual:
      return Relation::kGreater;
    case Relation::kGreater:
      return Relation::kLessOrEqual;
    case Relation::kGreaterOrEqual:
      return Relation::kLess;
    case Relation::kPredicate:
    case Relation::kExtern:
    case Relation::kEqual:
      break;
  }
  return relation;
}

GroundQuery Constant(bool value) {
  GroundQuery query;
  query.kind = value ? GroundQuery::Kind::kAnd : GroundQuery::Kind::kOr;
  return query;
}

GroundQuery Not(GroundQuery operand) {
  if (operand.IsTrue() || operand.IsFalse()) return Constant(operand.IsFalse());
  GroundQuery query;
  query.kind = GroundQuery::Kind::kNot;
  query.operands.push_back(std::move(operand));
  return query;
}

// kAnd or kOr of the operands, flattened, without what does not matter.
GroundQuery Join(GroundQuery::Kind kind, std::vector<GroundQuery> operands) {
  const bool is_and = kind == GroundQuery::Kind::kAnd;
  GroundQuery query;
  query.kind = kind;
  for (GroundQuery& operand : operands) {
    if (is_and ? operand.IsFalse() : operand.IsTrue()) return Constant(!is_and);
    if (operand.kind == kind) {
      std::move(operand.operands.begin(), operand.operands.end(),
                std::back_inserter(query.operands));
    } else {
      query.operands.push_back(std::move(operand));
    }
  }
  if (query.operands.size() == 1) return std::move(query.operands.front());
  return query;
}

GroundQuery Known(GroundLiteral literal) {
  GroundQuery query;
  query.kind = GroundQuery::Kind::kKnown;
  query.literal = literal;
  return query;
}

GroundQuery BoundKnown(const Bound& bound) {
  GroundQuery query;
  query.kind = GroundQuery::Kind::kBoundKnown;
  query.bound = bound;
  return query;
}

bool AsksOfLiteralsAlone(const GroundQuery& query) {
  switch (query.kind) {
    case GroundQuery::Kind::kKnown:
      return true;
    case GroundQuery::Kind::kAnd:
    case GroundQuery::Kind::kOr:
      return std::all_of(query.operands.begin(), query.operands.end(), AsksOfLiteralsAlone);
    case GroundQuery::Kind::kNot:
    case GroundQuery::Kind::kBoundKnown:
    case GroundQuery::Kind::kSensed:
    case GroundQuery::Kind::kValueSensed:
      return false;
  }
  return false;
}

class Grounder {
 public:
  Grounder(const Domain& domain, const Problem& problem, const SymbolTable& symbols,
           Externs& externs)
      : domain_(domain),
        problem_(problem),
        symbols_(symbols),
        externs_(externs),
        table_(domain, problem, symbols, task_) {}

  GroundTask Run() {
    TellInit();
    file_ = &domain_.file;
    for (const Action& action : domain_.actions) GroundInstances(action);
    for (const Effect& update : domain_.updates) AddEffects(update, {}, task_.updates);
    file_ = &problem_.file;
    task_.goal = QueryOf(problem_.goal, {});
    GroundInit();
    return std::move(task_);
  }

 private:
  using Bindings = std::vector<Binding>;

  [[noreturn]] void Fail(Place place, const std::string& what, const std::string& allowed) const {
    throw InputError({*file_, place.line, place.column}, what, allowed);
  }

  // ---- Init

  // First what decides which atoms are always known; the rest when all atoms are there.
  void TellInit() {
    file_ = &problem_.file;
    for (const Change& change : problem_.init) {
      if (change.store == Store::kExclusive) TellUnknown(change);
      if (change.store == Store::kClosed) table_.Close(change);
    }
    for (const Change& change : problem_.init) {
      if (change.store == Store::kFacts) TellFact(change);
    }
  }

  void TellUnknown(const Change& change) {
    for (const Literal& literal : change.literals) {
      if (literal.relation == Relation::kPredicate) {
        table_.Tell(AtomText(literal.predicate, Constants(literal.arguments, {})),
                    Knowledge::kUnknown);
      }
    }
  }

  void TellFact(const Change& change) {
    const Literal& literal = change.literals.front();
    const auto knowledge = [&](bool is_positive) {
      if (!change.is_addition) return Knowledge::kUnknown;
      return is_positive ? Knowledge::kTrue : Knowledge::kFalse;
    };
    if (literal.relation == Relation::kPredicate) {
      table_.Tell(AtomText(literal.predicate, Constants(literal.arguments, {})),
                  knowledge(literal.is_positive));
    } else if (const auto equality = EqualityOf(literal)) {
      const GroundFunction& function = task_.functions[equality->first.index()];
      if (literal.is_positive) {
        for (const std::string& constant : function.constants) {
          table_.Tell(function.text + " = " + constant, knowledge(constant == equality->second));
        }
      } else {
        table_.Tell(function.text + " = " + equality->second, knowledge(false));
      }
    }
  }

  // f(a) = c of objects.
  std::optional<std::pair<FunctionId, std::string>> EqualityOf(const Literal& literal) {
    const Term& left = literal.arguments[0];
    const Term& right = literal.arguments[1];
    const Term& function = left.kind == Term::Kind::kFunction ? left : right;
    const Term& constant = left.kind == Term::Kind::kFunction ? right : left;
    if (IsNumeric(function)) return std::nullopt;
    if (function.kind != Term::Kind::kFunction || constant.kind != Term::Kind::kConstant) {
      Fail(literal.place, "not a value of a function", "f(...) = constant");
    }
    return {{FunctionOf(function, {}), constant.name}};
  }

  void GroundInit() {
    InitialKnowledge& initial = task_.initial;
    for (const Change& change : problem_.init) GroundInit(change);
    initial.known = table_.KnownAtFirst();
    GroundRanges();
  }

  void GroundInit(const Change& change) {
    InitialKnowledge& initial = task_.initial;
    if (change.store == Store::kFacts || change.store == Store::kClosed) return;
    for (const GroundChange& ground : ChangesOf(change, {})) {
      if (!change.is_addition) continue;
      if (change.store == Store::kWhether) initial.sensed.push_back(ground.formula);
      if (change.store == Store::kValues) initial.values_sensed.push_back(ground.function);
      if (change.store == Store::kExclusive) AddRelation(ground, change.place);
    }
  }

  // Alternatives that are values of one function are all that it can have.
  void AddRelation(const GroundChange& change, Place place) {
    InitialKnowledge& initial = task_.initial;
    initial.relations.push_back(
        {change.literals, change.is_inclusive, {*file_, place.line, place.column}});
    const FunctionId function = task_.function_of_atom[change.literals.front().atom.index()];
    const bool is_range =
        !function.IsNone() &&
        std::all_of(change.literals.begin(), change.literals.end(), [&](const GroundLiteral& l) {
          return l.is_positive && task_.function_of_atom[l.atom.index()] == function;
        });
    if (!is_range) return;
    for (const AtomId value : task_.functions[function.index()].values) {
      const bool is_alternative =
          std::any_of(change.literals.begin(), change.literals.end(),
                      [&](const GroundLiteral& l) { return l.atom == value; });
      if (!is_alternative) table_.Tell(task_.atoms[value.index()], Knowledge::kFalse);
    }
  }

  void GroundRanges() {
    std::vector<Range>& ranges = task_.initial.ranges;
    ranges.assign(task_.function_of_slot.size(), {-kInfinity, kInfinity, false, false});
    for (const Change& change : problem_.init) {
      if (change.store != Store::kFacts || !change.is_addition ||
          change.literals.front().relation == Relation::kPredicate) {
        continue;
      }
      for (const GroundChange& ground : ChangesOf(change, {})) NarrowRange(ground, change.place);
    }
  }

  void NarrowRange(const GroundChange& change, Place place) {
    std::vector<Range>& ranges = task_.initial.ranges;
    ranges.resize(task_.function_of_slot.size(), {-kInfinity, kInfinity, false, false});
    if (change.kind == GroundChange::Kind::kAssign) {
      if (!change.sum.functions.empty()) Fail(place, "not a number", "a number or an interval");
      Range& range = ranges[SlotOf(change.function)];
      range = {change.sum.constant.low, change.sum.constant.high, false, false};
    } else if (change.kind == GroundChange::Kind::kNarrow) {
      Range& range = ranges[SlotOf(change.bound.function)];
      const bool is_upper = change.bound.relation == Relation::kLess ||
                            change.bound.relation == Relation::kLessOrEqual;
      (is_upper ? range.high : range.low) = change.bound.value;
      (is_upper ? range.excludes_high : range.excludes_low) =
          change.bound.relation == Relation::kLess || change.bound.relation == Relation::kGreater;
    }
  }

  int SlotOf(FunctionId function) const { return task_.functions[function.index()].slot; }

  // ---- Instances of actions

  // A literal of the precondition that is answered as soon as its variables are bound.
  struct EarlyTest {
    const Literal* literal;
    std::size_t after;  // so many parameters are bound
  };

  void GroundInstances(const Action& action) {
    std::vector<EarlyTest> tests;
    CollectEarlyTests(action, action.precondition, tests);
    std::stable_sort(tests.begin(), tests.end(), [](const EarlyTest& a, const EarlyTest& b) {
      return (a.literal->relation == Relation::kExtern) <
             (b.literal->relation == Relation::kExtern);
    });
    Bindings bindings;
    BindFrom(action, tests, bindings);
  }

  void CollectEarlyTests(const Action& action, const Query& query, std::vector<EarlyTest>& tests) {
    if (query.kind == Query::Kind::kAnd) {
      for (const Query& operand : query.operands) CollectEarlyTests(action, operand, tests);
    }
    if (query.kind != Query::Kind::kKnown) return;
    for (const Literal& literal : query.literals) {
      const bool is_early =
          literal.relation == Relation::kExtern ||
          (literal.relation == Relation::kPredicate && !table_.IsChanged(literal.predicate)) ||
          (literal.relation == Relation::kEqual && !HasFunction(literal));
      if (is_early) tests.push_back({&literal, LastBound(action, literal)});
    }
  }

  static bool HasFunction(const Literal& literal) {
    return std::any_of(literal.arguments.begin(), literal.arguments.end(),
                       [](const Term& t) { return t.kind == Term::Kind::kFunction; });
  }

  static std::size_t LastBound(const Action& action, const Literal& literal) {
    std::size_t last = 0;
    for (const Term& term : literal.arguments) {
      for (std::size_t i = 0; i < action.parameters.size(); ++i) {
        const bool is_it =
            term.kind == Term::Kind::kVariable && term.name == action.parameters[i].name;
        if (is_it) last = std::max(last, i + 1);
      }
    }
    return last;
  }

  void CountBinding(Place place) {
    if (++bindings_ > kMostBindings) {
      Fail(place, "too many ways to bind variables", fmt::format("{}", kMostBindings));
    }
  }

  void BindFrom(const Action& action, const std::vector<EarlyTest>& tests, Bindings& bindings) {
    CountBinding(action.place);
    const bool passes = std::all_of(tests.begin(), tests.end(), [&](const EarlyTest& test) {
      return test.after != bindings.size() || !KnownLiteral(*test.literal, bindings).IsFalse();
    });
    if (!passes) {
      is_unsupported_ = false;
      return;
    }
    if (bindings.size() == action.parameters.size()) {
      AddInstance(action, bindings);
      return;
    }
    const TypedName& parameter = action.parameters[bindings.size()];
    for (const Value& value : CandidatesFor(action, parameter, bindings)) {
      bindings.push_back({parameter.name, value});
      BindFrom(action, tests, bindings);
      bindings.pop_back();
    }
  }

  std::vector<Value> CandidatesFor(const Action& action, const TypedName& parameter,
                                   const Bindings& bindings) {
    std::vector<Value> candidates;
    for (const std::string& constant : symbols_.ConstantsOf(parameter.type)) {
      candidates.push_back({constant, FunctionId::None()});
    }
    AddRunTimeValues(action.precondition, parameter.name, bindings, candidates);
    return candidates;
  }

  // K(parameter = f(a)) in the precondition, where f(a) may come to be known.
  void AddRunTimeValues(const Query& query, const std::string& parameter, const Bindings& bindings,
                        std::vector<Value>& candidates) {
    if (query.kind == Query::Kind::kAnd) {
      for (const Query& operand : query.operands) {
        AddRunTimeValues(operand, parameter, bindings, candidates);
      }
    }
    if (query.kind != Query::Kind::kKnown) return;
    for (const Literal& literal : query.literals) {
      if (literal.relation != Relation::kEqual || !literal.is_positive) continue;
      const Term& left = literal.arguments[0];
      const Term& right = literal.arguments[1];
      const bool is_on_left = left.kind == Term::Kind::kVariable && left.name == parameter;
      const bool is_on_right = right.kind == Term::Kind::kVariable && right.name == parameter;
      const Term& other = is_on_left ? right : left;
      if (is_on_left == is_on_right || other.kind != Term::Kind::kFunction || IsNumeric(other) ||
          !table_.IsSensed(other.name) || !AreBound(other, bindings)) {
        continue;
      }
      const FunctionId function = FunctionOf(other, bindings);
      candidates.push_back({task_.functions[function.index()].text, function});
    }
  }

  static bool AreBound(const Term& function, const Bindings& bindings) {
    return std::all_of(function.arguments.begin(), function.arguments.end(), [&](const Term& t) {
      return t.kind != Term::Kind::kVariable ||
             std::any_of(bindings.begin(), bindings.end(), [&](const Binding& b) {
               return b.variable == t.name && b.value.function.IsNone();
             });
    });
  }

  void AddInstance(const Action& action, const Bindings& bindings) {
    GroundAction instance;
    instance.name = action.name;
    for (const Binding& binding : bindings) {
      instance.arguments.push_back(binding.value.text);
      instance.run_time_values.push_back(binding.value.function);
    }
    instance.precondition = QueryOf(action.precondition, bindings);
    if (!instance.precondition.IsFalse()) {
      for (const Effect& effect : action.effects) AddEffects(effect, bindings, instance.effects);
    }
    if (!std::exchange(is_unsupported_, false) && !instance.precondition.IsFalse()) {
      task_.actions.push_back(std::move(instance));
    }
  }

  // Calls `use` with the bindings and each way to bind the variables as well.
  void ForEachBinding(const std::vector<TypedName>& variables, Bindings& bindings, std::size_t from,
                      const std::function<void()>& use) {
    if (from == variables.size()) {
      use();
      return;
    }
    for (const std::string& constant : symbols_.ConstantsOf(variables[from].type)) {
      CountBinding(variables[from].place);
      bindings.push_back({variables[from].name, {constant, FunctionId::None()}});
      ForEachBinding(variables, bindings, from + 1, use);
      bindings.pop_back();
    }
  }

  // ---- Effects

  void AddEffects(const Effect& effect, Bindings bindings, std::vector<GroundEffect>& to) {
    ForEachBinding(effect.variables, bindings, 0, [&] {
      const GroundQuery condition = QueryOf(effect.condition, bindings);
      if (condition.IsFalse()) return;
      GroundEffect ground{condition, AsksOfLiteralsAlone(condition), {}};
      for (const Change& change : effect.changes) {
        for (GroundChange& made : ChangesOf(change, bindings)) {
          ground.changes.push_back(std::move(made));
        }
      }
      if (!ground.changes.empty()) to.push_back(std::move(ground));
    });
  }

  std::vector<GroundChange> ChangesOf(const Change& change, const Bindings& bindings) {
    switch (change.store) {
      case Store::kFacts:
        return FactChanges(change, bindings);
      case Store::kWhether:
        return WhetherChanges(change.literals, change.is_addition, bindings);
      case Store::kValues:
        return {{.kind = change.is_addition ? GroundChange::Kind::kSenseValue
                                            : GroundChange::Kind::kUnsenseValue,
                 .function = FunctionOf(change.terms.front(), bindings),
                 .error = change.within.value_or(0)}};
      case Store::kExclusive:
        return RelationChanges(change, bindings);
      case Store::kClosed:
        return ClosedChanges(change, bindings);
    }
    return {};
  }

  std::vector<GroundChange> FactChanges(const Change& change, const Bindings& bindings) {
    const Literal& literal = change.literals.front();
    if (literal.relation == Relation::kPredicate) {
      const AtomId atom = table_.Atom(literal.predicate, Constants(literal.arguments, bindings));
      return {{.kind = change.is_addition ? GroundChange::Kind::kSet : GroundChange::Kind::kForget,
               .literal = {atom, literal.is_positive}}};
    }
    const bool is_left = literal.arguments[0].kind == Term::Kind::kFunction;
    const Term& function = literal.arguments[is_left ? 0 : 1];
    if (function.kind != Term::Kind::kFunction) {
      Fail(literal.place, "no function", "f(...) = constant");
    }
    if (IsNumeric(function)) return NumberChanges(change, literal, bindings);
    return ValueChanges(change, FunctionOf(function, bindings),
                        ValueOf(literal.arguments[is_left ? 1 : 0], bindings), literal);
  }

  // A function has one value: the others become false with it, and unknown with it.
  std::vector<GroundChange> ValueChanges(const Change& change, FunctionId id, const Value& value,
                                         const Literal& literal) {
    std::vector<GroundChange> changes;
    if (!value.function.IsNone()) {
      is_unsupported_ = true;
      return changes;
    }
    const AtomId atom = table_.Value(id, value.text);
    if (atom.IsNone()) {
      if (literal.is_positive && change.is_addition) is_unsupported_ = true;  // no such value
      return changes;
    }
    if (change.is_addition && !literal.is_positive) {
      return {{.kind = GroundChange::Kind::kSet, .literal = {atom, false}}};
    }
    for (const AtomId other : task_.functions[id.index()].values) {
      changes.push_back(
          {.kind = change.is_addition ? GroundChange::Kind::kSet : GroundChange::Kind::kForget,
           .literal = {other, other == atom}});
    }
    return changes;
  }

  std::vector<GroundChange> NumberChanges(const Change& change, const Literal& literal,
                                          const Bindings& bindings) {
    const FunctionId function = FunctionOf(literal.arguments[0], bindings);
    if (!change.is_addition) {
      return {{.kind = GroundChange::Kind::kForgetNumber, .function = function}};
    }
    const GroundSum sum = SumOf(literal.arguments[1], bindings);
    if (literal.relation == Relation::kEqual) {
      return {{.kind = GroundChange::Kind::kAssign, .function = function, .sum = sum}};
    }
    if (!sum.functions.empty() || sum.constant.low != sum.constant.high) {
      Fail(literal.place, "not a bound", "f(...) <, <=, > or >= and a number");
    }
    return {{.kind = GroundChange::Kind::kNarrow,
             .function = function,
             .bound = BoundOf(literal, bindings)}};
  }

  GroundSum SumOf(const Term& term, const Bindings& bindings) {
    GroundSum sum;
    if (term.kind == Term::Kind::kNumber) {
      sum.constant = term.value;
    } else if (term.kind == Term::Kind::kFunction) {
      sum.functions.emplace_back(FunctionOf(term, bindings), 1);
    } else {
      const bool is_sum = term.kind == Term::Kind::kSum;
      sum = SumOf(term.arguments[0], bindings);
      const GroundSum right = SumOf(term.arguments[1], bindings);
      sum.constant.low += is_sum ? right.constant.low : -right.constant.high;
      sum.constant.high += is_sum ? right.constant.high : -right.constant.low;
      for (const auto& [function, sign] : right.functions) {
        sum.functions.emplace_back(function, is_sum ? sign : -sign);
      }
    }
    return sum;
  }

  Bound BoundOf(const Literal& literal, const Bindings& bindings) {
    return {FunctionOf(literal.arguments[0], bindings),
            literal.is_positive ? literal.relation : Complement(literal.relation),
            literal.arguments[1].value.low};
  }

  std::vector<GroundChange> WhetherChanges(const std::vector<Literal>& literals, bool is_addition,
                                           const Bindings& bindings) {
    const auto formula = FormulaOf(literals, bindings);
    if (!formula) return {};
    return {{.kind = is_addition ? GroundChange::Kind::kSense : GroundChange::Kind::kUnsense,
             .formula = *formula}};
  }

  // None if what it says is always known.
  std::optional<FormulaId> FormulaOf(const std::vector<Literal>& literals,
                                     const Bindings& bindings) {
    Formula formula;
    for (const Literal& literal : literals) {
      const GroundQuery known = KnownLiteral(literal, bindings);
      if (known.IsFalse() && !is_unsupported_) return std::nullopt;
      if (known.kind == GroundQuery::Kind::kBoundKnown) formula.bound = known.bound;
      if (known.kind == GroundQuery::Kind::kKnown) formula.literals.push_back(known.literal);
    }
    if (formula.literals.empty() && !formula.bound) return std::nullopt;
    return table_.IdOf(formula);
  }

  std::vector<GroundChange> RelationChanges(const Change& change, const Bindings& bindings) {
    GroundChange relation;
    relation.kind = GroundChange::Kind::kRelate;
    relation.is_inclusive = change.is_inclusive;
    for (const Literal& literal : change.literals) {
      AtomId atom;
      if (literal.relation == Relation::kPredicate) {
        atom = table_.Atom(literal.predicate, Constants(literal.arguments, bindings));
      } else if (const auto equality = EqualityOf(literal)) {
        atom = table_.Value(equality->first, equality->second);
      }
      if (atom.IsNone()) Fail(literal.place, "no value of this function", "one of its type");
      relation.literals.push_back({atom, literal.is_positive});
    }
    return {relation};
  }

  // What an action learns of all instances: of each of them whether it is true.
  std::vector<GroundChange> ClosedChanges(const Change& change, Bindings bindings) {
    std::vector<GroundChange> changes;
    ForEachBinding(change.variables, bindings, 0, [&] {
      for (GroundChange& ground : WhetherChanges(change.literals, change.is_addition, bindings)) {
        changes.push_back(std::move(ground));
      }
    });
    return changes;
  }

  // ---- Queries

  GroundQuery QueryOf(const Query& query, Bindings bindings) {
    std::vector<GroundQuery> parts;
    switch (query.kind) {
      case Query::Kind::kKnown:
        for (const Literal& literal : query.literals) {
          parts.push_back(KnownLiteral(literal, bindings));
        }
        return Join(GroundQuery::Kind::kAnd, std::move(parts));
      case Query::Kind::kKnownWhether:
        return KnownWhether(query, bindings);
      case Query::Kind::kValueKnown:
        return ValueKnown(FunctionOf(query.terms.front(), bindings), query.within);
      case Query::Kind::kNot:
        return Not(QueryOf(query.operands.front(), bindings));
      case Query::Kind::kAnd:
      case Query::Kind::kOr:
        for (const Query& operand : query.operands) parts.push_back(QueryOf(operand, bindings));
        break;
      case Query::Kind::kForAll:
      case Query::Kind::kExists:
        ForEachBinding(query.variables, bindings, 0,
                       [&] { parts.push_back(QueryOf(query.operands.front(), bindings)); });
        break;
    }
    const bool is_and = query.kind == Query::Kind::kAnd || query.kind == Query::Kind::kForAll;
    return Join(is_and ? GroundQuery::Kind::kAnd : GroundQuery::Kind::kOr, std::move(parts));
  }

  // Kw(a & b): sensed, or both known true, or one of them known false (facts on PKS: Kw(a) holds
  // if K(a) or K(!a) does).
  GroundQuery KnownWhether(const Query& query, const Bindings& bindings) {
    std::vector<GroundQuery> all;
    std::vector<GroundQuery> ways;
    for (const Literal& literal : query.literals) {
      all.push_back(KnownLiteral(literal, bindings));
      Literal negation = literal;
      negation.is_positive = !literal.is_positive;
      ways.push_back(KnownLiteral(negation, bindings));
    }
    ways.push_back(Join(GroundQuery::Kind::kAnd, std::move(all)));
    if (const auto formula = FormulaOf(query.literals, bindings)) {
      GroundQuery sensed;
      sensed.kind = GroundQuery::Kind::kSensed;
      sensed.formula = *formula;
      ways.push_back(std::move(sensed));
    }
    return Join(GroundQuery::Kind::kOr, std::move(ways));
  }

  GroundQuery ValueKnown(FunctionId function, std::optional<double> within = std::nullopt) {
    std::vector<GroundQuery> ways(1);
    ways.front().kind = GroundQuery::Kind::kValueSensed;
    ways.front().function = function;
    ways.front().within = within;
    for (const AtomId value : task_.functions[function.index()].values) {
      ways.push_back(Known({value, true}));
    }
    return Join(GroundQuery::Kind::kOr, std::move(ways));
  }

  GroundQuery KnownLiteral(const Literal& literal, const Bindings& bindings) {
    switch (literal.relation) {
      case Relation::kPredicate:
        return KnownAtom(literal, bindings);
      case Relation::kExtern: {
        const std::vector<std::string> arguments = Constants(literal.arguments, bindings);
        if (is_unsupported_) return Constant(false);
        const FilePlace place{*file_, literal.place.line, literal.place.column};
        return Constant(externs_.Call(literal.predicate, arguments, place) == literal.is_positive);
      }
      case Relation::kEqual:
        return KnownEqual(literal, bindings);
      case Relation::kLess:
      case Relation::kLessOrEqual:
      case Relation::kGreater:
      case Relation::kGreaterOrEqual:
        return BoundKnown(BoundOf(literal, bindings));
    }
    return {};
  }

  GroundQuery KnownAtom(const Literal& literal, const Bindings& bindings) {
    const std::vector<std::string> arguments = Constants(literal.arguments, bindings);
    if (is_unsupported_) return Constant(false);
    const Knowledge knowledge = table_.AlwaysKnown(literal.predicate, arguments);
    if (knowledge != Knowledge::kUnknown) {
      return Constant((knowledge == Knowledge::kTrue) == literal.is_positive);
    }
    return Known({table_.Atom(literal.predicate, arguments), literal.is_positive});
  }

  GroundQuery KnownEqual(const Literal& literal, const Bindings& bindings) {
    const Value left = ValueOf(literal.arguments[0], bindings);
    const Value right = ValueOf(literal.arguments[1], bindings);
    if (left.function.IsNone() && right.function.IsNone()) {
      return Constant((left.text == right.text) == literal.is_positive);
    }
    if (!left.function.IsNone() && !right.function.IsNone()) {
      return FunctionsEqual(left.function, right.function, literal.is_positive);
    }
    const bool is_left = !left.function.IsNone();
    const AtomId atom =
        table_.Value(is_left ? left.function : right.function, is_left ? right.text : left.text);
    return atom.IsNone() ? Constant(!literal.is_positive) : Known({atom, literal.is_positive});
  }

  GroundQuery FunctionsEqual(FunctionId f, FunctionId g, bool is_positive) {
    if (f == g) return is_positive ? ValueKnown(f) : Constant(false);
    std::vector<GroundQuery> ways;
    for (const std::string& constant : task_.functions[f.index()].constants) {
      const AtomId of_g = table_.Value(g, constant);
      if (of_g.IsNone()) continue;
      const AtomId of_f = table_.Value(f, constant);
      // Different: of some constant one is known to be it, and the other not to be it.
      ways.push_back(
          Join(GroundQuery::Kind::kAnd, {Known({of_f, true}), Known({of_g, is_positive})}));
      if (!is_positive) {
        ways.push_back(Join(GroundQuery::Kind::kAnd, {Known({of_f, false}), Known({of_g, true})}));
      }
    }
    return Join(GroundQuery::Kind::kOr, std::move(ways));
  }

  // ---- Terms

  bool IsNumeric(const Term& term) const {
    if (term.kind != Term::Kind::kFunction) {
      return term.kind != Term::Kind::kConstant && term.kind != Term::Kind::kVariable;
    }
    return symbols_.FindFunction(term.name)->range == kNumberType;
  }

  Value ValueOf(const Term& term, const Bindings& bindings) {
    if (term.kind == Term::Kind::kFunction) {
      const FunctionId function = FunctionOf(term, bindings);
      return {task_.functions[function.index()].text, function};
    }
    if (term.kind == Term::Kind::kConstant) return {term.name, FunctionId::None()};
    for (auto binding = bindings.rbegin(); binding != bindings.rend(); ++binding) {
      if (binding->variable == term.name) return binding->value;
    }
    return {};
  }

  // Arguments of a predicate, a function or an extern: no run-time variables.
  std::vector<std::string> Constants(const std::vector<Term>& terms, const Bindings& bindings) {
    std::vector<std::string> constants;
    constants.reserve(terms.size());
    for (const Term& term : terms) {
      Value value = ValueOf(term, bindings);
      if (!value.function.IsNone()) is_unsupported_ = true;
      constants.push_back(std::move(value.text));
    }
    return constants;
  }

  FunctionId FunctionOf(const Term& term, const Bindings& bindings) {
    return table_.Function(term.name, Constants(term.arguments, bindings));
  }

  const Domain& domain_;
  const Problem& problem_;
  const SymbolTable& symbols_;
  Externs& externs_;
  GroundTask task_;
  AtomTable table_;
  const std::string* file_ = nullptr;  // of what is being grounded
  std::int64_t bindings_ = 0;          // that have been looked at
  bool is_unsupported_ = false;        // a run-time variable stands where none may
};

}  // namespace

GroundTask Ground(Domain domain, Problem problem, Externs& externs) {
  const SymbolTable symbols(domain, problem);
  CheckTypes(domain, problem, symbols);
  externs.AddFacts(problem);
  return Grounder(domain, problem, symbols, externs).Run();
}

}  // namespace assay::contingent
