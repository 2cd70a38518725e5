#include "planner/contingent/grounding/action_grounding.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "planner/contingent/language/two_values.h"

namespace assay::contingent {
namespace {

constexpr std::size_t kMostActions = 100'000;

bool HasFunction(const Literal& literal) {
  return std::any_of(literal.arguments.begin(), literal.arguments.end(),
                     [](const Term& t) { return t.kind == Term::Kind::kFunction; });
}

std::size_t LastBound(const Action& action, const Literal& literal) {
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

bool AreBound(const Term& function, const Bindings& bindings) {
  return std::all_of(function.arguments.begin(), function.arguments.end(), [&](const Term& t) {
    return t.kind != Term::Kind::kVariable ||
           std::any_of(bindings.begin(), bindings.end(), [&](const Binding& b) {
             return b.variable == t.name && b.value.function.IsNone();
           });
  });
}

}  // namespace

void ActionGrounding::AddInstances(const Action& action) {
  std::vector<EarlyTest> tests;
  CollectEarlyTests(action, action.precondition, tests);
  std::stable_sort(tests.begin(), tests.end(), [](const EarlyTest& a, const EarlyTest& b) {
    return (a.literal->relation == Relation::kExtern) < (b.literal->relation == Relation::kExtern);
  });
  RequireFew(action, tests);
  const std::size_t first = terms_.task().actions.size();
  Bindings bindings;
  BindFrom(action, tests, bindings, [&] { AddInstance(action, bindings); });
  RequireSingleValues(action, first);
}

void ActionGrounding::RequireFew(const Action& action, const std::vector<EarlyTest>& tests) {
  double ways = 1;
  for (const TypedName& parameter : action.parameters) {
    ways *= static_cast<double>(terms_.symbols().ConstantsOf(parameter.type).size());
  }
  std::size_t count = terms_.task().actions.size();
  if (static_cast<double>(count) + ways <= kMostActions) return;
  Bindings bindings;
  BindFrom(action, tests, bindings, [&] {
    if (++count <= kMostActions) return;
    terms_.Fail(action.place,
                fmt::format("action '{}' has {:.15g} instances; too many remain after the initial "
                            "knowledge rules some out",
                            action.name, ways),
                fmt::format("{} ground actions in all", kMostActions));
  });
}

void ActionGrounding::CollectEarlyTests(const Action& action, const Query& query,
                                        std::vector<EarlyTest>& tests) {
  if (query.kind == Query::Kind::kAnd) {
    for (const Query& operand : query.operands) CollectEarlyTests(action, operand, tests);
  }
  if (query.kind != Query::Kind::kKnown) return;
  for (const Literal& literal : query.literals) {
    const bool is_early = literal.relation == Relation::kExtern ||
                          (literal.relation == Relation::kPredicate &&
                           !terms_.table().IsChanged(literal.predicate)) ||
                          (literal.relation == Relation::kEqual && !HasFunction(literal));
    if (is_early) tests.push_back({&literal, LastBound(action, literal)});
  }
}

void ActionGrounding::BindFrom(const Action& action, const std::vector<EarlyTest>& tests,
                               Bindings& bindings, const std::function<void()>& use) {
  terms_.CountBinding(action.place);
  const bool passes = std::all_of(tests.begin(), tests.end(), [&](const EarlyTest& test) {
    return test.after != bindings.size() ||
           !queries_.KnownLiteral(*test.literal, bindings).IsFalse();
  });
  if (!passes) {
    terms_.TakeRefusal();
    return;
  }
  if (bindings.size() == action.parameters.size()) {
    use();
    return;
  }
  const TypedName& parameter = action.parameters[bindings.size()];
  for (const GroundValue& value : CandidatesFor(action, parameter, bindings)) {
    bindings.push_back({parameter.name, value});
    BindFrom(action, tests, bindings, use);
    bindings.pop_back();
  }
}

std::vector<GroundValue> ActionGrounding::CandidatesFor(const Action& action,
                                                        const TypedName& parameter,
                                                        const Bindings& bindings) {
  std::vector<GroundValue> candidates;
  for (const std::string& constant : terms_.symbols().ConstantsOf(parameter.type)) {
    candidates.push_back({constant, FunctionId::None()});
  }
  AddRunTimeValues(action.precondition, parameter.name, bindings, candidates);
  return candidates;
}

// Adds the run-time variables for a precondition K(parameter = f(a)) where f(a) may be sensed.
void ActionGrounding::AddRunTimeValues(const Query& query, const std::string& parameter,
                                       const Bindings& bindings,
                                       std::vector<GroundValue>& candidates) {
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
    if (is_on_left == is_on_right || other.kind != Term::Kind::kFunction ||
        terms_.IsNumeric(other) || !terms_.table().IsSensed(other.name) ||
        !AreBound(other, bindings)) {
      continue;
    }
    const FunctionId function = terms_.FunctionOf(other, bindings);
    candidates.push_back({terms_.task().functions[function.index()].text, function});
  }
}

void ActionGrounding::AddInstance(const Action& action, const Bindings& bindings) {
  GroundAction instance;
  instance.name = action.name;
  instance.place = action.place;
  for (const Binding& binding : bindings) {
    instance.arguments.push_back(binding.value.text);
    instance.run_time_values.push_back(binding.value.function);
  }
  instance.precondition = queries_.QueryOf(action.precondition, bindings);
  if (!instance.precondition.IsFalse()) {
    for (const Effect& effect : action.effects)
      effects_.AddEffects(effect, bindings, instance.effects);
  }
  if (!terms_.TakeRefusal() && !instance.precondition.IsFalse()) {
    terms_.task().actions.push_back(std::move(instance));
  }
}

// An instance that gives a function two values is never executed. Such instances are an error of
// the domain only if the action has no other instance.
void ActionGrounding::RequireSingleValues(const Action& action, std::size_t first) const {
  const std::vector<GroundAction>& all = terms_.task().actions;
  std::optional<TwoValues> found;
  for (std::size_t i = first; i < all.size(); ++i) {
    const std::optional<TwoValues> given = TwoValuesOf(action, all[i]);
    if (!given) return;
    if (!found) found = given;
  }
  if (!found) return;
  terms_.Fail(found->place,
              fmt::format("{} gets two values at once",
                          terms_.task().functions[found->function.index()].text),
              "one value for each function");
}

std::optional<ActionGrounding::TwoValues> ActionGrounding::TwoValuesOf(
    const Action& action, const GroundAction& instance) const {
  const auto is_always = [&](const GroundEffect& ground) {
    return std::ranges::any_of(action.effects, [&](const Effect& effect) {
      const Query& condition = effect.condition;
      return effect.place == ground.place && condition.kind == Query::Kind::kAnd &&
             condition.operands.empty();
    });
  };
  std::vector<const GroundChange*> given;
  for (const GroundEffect& effect : instance.effects) {
    if (!is_always(effect)) continue;
    for (const GroundChange& change : effect.changes) {
      const FunctionId function = FunctionGiven(terms_.task(), change);
      if (function.IsNone()) continue;
      for (const GroundChange* other : given) {
        if (GiveTwoValues(terms_.task(), *other, change)) return TwoValues{effect.place, function};
      }
      given.push_back(&change);
    }
  }
  return std::nullopt;
}

}  // namespace assay::contingent
