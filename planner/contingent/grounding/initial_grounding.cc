#include "planner/contingent/grounding/initial_grounding.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace assay::contingent {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Range kAnything = {.low = -kInfinity, .high = kInfinity};

}  // namespace

void InitialGrounding::Tell() {
  terms_.Enter(problem_.file);
  for (const Change& change : problem_.init) {
    if (change.store == Store::kExclusive) TellUnknown(change);
    if (change.store == Store::kClosed) terms_.table().Close(change);
  }
  for (const Change& change : problem_.init) {
    if (change.store == Store::kFacts) TellFact(change);
  }
}

void InitialGrounding::TellUnknown(const Change& change) {
  for (const Literal& literal : change.literals) {
    if (literal.relation == Relation::kPredicate) {
      terms_.table().Tell(AtomText(literal.predicate, terms_.Constants(literal.arguments, {})),
                          Knowledge::kUnknown);
    }
  }
}

void InitialGrounding::TellFact(const Change& change) {
  const Literal& literal = change.literals.front();
  const auto knowledge = [&](bool is_positive) {
    if (!change.is_addition) return Knowledge::kUnknown;
    return is_positive ? Knowledge::kTrue : Knowledge::kFalse;
  };
  if (literal.relation == Relation::kPredicate) {
    TellAtom(AtomText(literal.predicate, terms_.Constants(literal.arguments, {})),
             knowledge(literal.is_positive), change.place);
  } else if (const auto equality = terms_.EqualityOf(literal, {})) {
    const GroundFunction& function = terms_.task().functions[equality->first.index()];
    if (literal.is_positive) {
      for (const std::string& constant : function.constants) {
        TellAtom(function.text + " = " + constant, knowledge(constant == equality->second),
                 change.place);
      }
    } else {
      TellAtom(function.text + " = " + equality->second, knowledge(false), change.place);
    }
    RequireValue(equality->first, change.place);
  }
}

void InitialGrounding::TellAtom(const std::string& atom, Knowledge knowledge, Place place) {
  const auto [stated, is_new] = stated_.try_emplace(atom, knowledge);
  const bool contradicts = stated->second != knowledge && stated->second != Knowledge::kUnknown &&
                           knowledge != Knowledge::kUnknown;
  if (contradicts) FailContradiction(place, fmt::format("{} is known to be true and false", atom));
  stated->second = knowledge;
  terms_.table().Tell(atom, knowledge);
}

void InitialGrounding::RequireValue(FunctionId id, Place place) const {
  const GroundFunction& function = terms_.task().functions[id.index()];
  const bool has_value = std::any_of(
      function.constants.begin(), function.constants.end(), [&](const std::string& constant) {
        const auto stated = stated_.find(function.text + " = " + constant);
        return stated == stated_.end() || stated->second != Knowledge::kFalse;
      });
  if (!has_value) FailContradiction(place, fmt::format("no value is left for {}", function.text));
}

void InitialGrounding::FailContradiction(Place place, const std::string& what) const {
  terms_.Fail(place, "this contradicts what is known: " + what,
              "what can hold together with the rest of init");
}

void InitialGrounding::Ground() {
  InitialKnowledge& initial = terms_.task().initial;
  for (const Change& change : problem_.init) Ground(change);
  initial.known = terms_.table().KnownAtFirst();
  GroundRanges();
}

void InitialGrounding::Ground(const Change& change) {
  InitialKnowledge& initial = terms_.task().initial;
  if (change.store == Store::kFacts || change.store == Store::kClosed) return;
  for (const GroundChange& ground : effects_.ChangesOf(change, {})) {
    if (!change.is_addition) continue;
    if (change.store == Store::kWhether) initial.sensed.push_back(ground.formula);
    if (change.store == Store::kValues) {
      const auto [value, is_new] = initial.values_sensed.try_emplace(ground.function, ground.error);
      value->second = std::min(value->second, ground.error);
    }
    if (change.store == Store::kExclusive) AddRelation(ground, change.place);
  }
}

// If all alternatives are values of one function, the function has no other values.
void InitialGrounding::AddRelation(const GroundChange& change, Place place) {
  InitialKnowledge& initial = terms_.task().initial;
  initial.relations.push_back({change.literals, change.is_inclusive, terms_.PlaceOf(place)});
  const FunctionId function = terms_.task().function_of_atom[change.literals.front().atom.index()];
  const bool is_range =
      !function.IsNone() &&
      std::all_of(change.literals.begin(), change.literals.end(), [&](const GroundLiteral& l) {
        return l.is_positive && terms_.task().function_of_atom[l.atom.index()] == function;
      });
  if (!is_range) return;
  for (const AtomId value : terms_.task().functions[function.index()].values) {
    const bool is_alternative =
        std::any_of(change.literals.begin(), change.literals.end(),
                    [&](const GroundLiteral& l) { return l.atom == value; });
    if (!is_alternative) terms_.table().Tell(terms_.task().atoms[value.index()], Knowledge::kFalse);
  }
}

void InitialGrounding::GroundRanges() {
  terms_.task().initial.ranges.assign(terms_.task().function_of_slot.size(), kAnything);
  for (const Change& change : problem_.init) {
    if (change.store != Store::kFacts || !change.is_addition ||
        change.literals.front().relation == Relation::kPredicate) {
      continue;
    }
    for (const GroundChange& ground : effects_.ChangesOf(change, {}))
      NarrowRange(ground, change.place);
  }
}

Range& InitialGrounding::RangeOf(FunctionId function) {
  GroundTask& task = terms_.task();
  task.initial.ranges.resize(task.function_of_slot.size(), kAnything);
  return task.initial.ranges[task.functions[function.index()].slot];
}

void InitialGrounding::NarrowRange(const GroundChange& change, Place place) {
  if (change.kind == GroundChange::Kind::kAssign) {
    if (!change.sum.functions.empty())
      terms_.Fail(place, "not a number", "a number or an interval");
    NarrowRange({change.function, Relation::kGreaterOrEqual, change.sum.constant.low}, place);
    NarrowRange({change.function, Relation::kLessOrEqual, change.sum.constant.high}, place);
  } else if (change.kind == GroundChange::Kind::kNarrow) {
    NarrowRange(change.bound, place);
  }
}

void InitialGrounding::NarrowRange(const Bound& bound, Place place) {
  Range& range = RangeOf(bound.function);
  const bool excludes = bound.relation == Relation::kLess || bound.relation == Relation::kGreater;
  const bool is_upper =
      bound.relation == Relation::kLess || bound.relation == Relation::kLessOrEqual;
  double& end = is_upper ? range.high : range.low;
  bool& excludes_end = is_upper ? range.excludes_high : range.excludes_low;
  if (bound.value == end) {
    excludes_end |= excludes;
  } else if (is_upper ? bound.value < end : bound.value > end) {
    end = bound.value;
    excludes_end = excludes;
  }
  const bool is_empty = range.low > range.high ||
                        (range.low == range.high && (range.excludes_low || range.excludes_high));
  if (is_empty) {
    FailContradiction(place, fmt::format("no number is left for {}",
                                         terms_.task().functions[bound.function.index()].text));
  }
}

}  // namespace assay::contingent
