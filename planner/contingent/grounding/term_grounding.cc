#include "planner/contingent/grounding/term_grounding.h"

#include <fmt/format.h>

#include <utility>

#include "planner/base/input_files/input_error.h"
#include "planner/contingent/language/decimal.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::contingent {
namespace {

// Limits on the work, so that no file keeps the program busy for hours or takes all memory.
constexpr std::int64_t kMostBindings = 20'000'000;
constexpr double kMostInstances = 1'000'000;

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

}  // namespace

void TermGrounding::Fail(Place place, const std::string& what, const std::string& allowed) const {
  throw InputError(PlaceOf(place), what, allowed);
}

bool TermGrounding::IsNumeric(const Term& term) const {
  if (term.kind != Term::Kind::kFunction) {
    return term.kind != Term::Kind::kConstant && term.kind != Term::Kind::kVariable;
  }
  return symbols_.FindFunction(term.name)->range == kNumberType;
}

GroundValue TermGrounding::ValueOf(const Term& term, const Bindings& bindings) {
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

std::vector<std::string> TermGrounding::Constants(const std::vector<Term>& terms,
                                                  const Bindings& bindings) {
  std::vector<std::string> constants;
  constants.reserve(terms.size());
  for (const Term& term : terms) {
    GroundValue value = ValueOf(term, bindings);
    if (!value.function.IsNone()) Refuse();
    constants.push_back(std::move(value.text));
  }
  return constants;
}

FunctionId TermGrounding::FunctionOf(const Term& term, const Bindings& bindings) {
  return table_.Function(term.name, Constants(term.arguments, bindings));
}

std::optional<std::pair<FunctionId, std::string>> TermGrounding::EqualityOf(
    const Literal& literal, const Bindings& bindings) {
  const Term& left = literal.arguments[0];
  const Term& right = literal.arguments[1];
  const Term& function = left.kind == Term::Kind::kFunction ? left : right;
  const Term& value = left.kind == Term::Kind::kFunction ? right : left;
  if (IsNumeric(function)) return std::nullopt;
  const bool is_value = value.kind == Term::Kind::kConstant || value.kind == Term::Kind::kVariable;
  if (function.kind != Term::Kind::kFunction || !is_value) {
    Fail(literal.place, "not a value of a function", "f(...) = constant");
  }
  return {{FunctionOf(function, bindings), Constants({value}, bindings).front()}};
}

GroundSum TermGrounding::SumOf(const Term& term, const Bindings& bindings) {
  GroundSum sum;
  if (term.kind == Term::Kind::kNumber) {
    sum.constant = term.value;
  } else if (term.kind == Term::Kind::kFunction) {
    sum.functions.emplace_back(FunctionOf(term, bindings), 1);
  } else {
    const bool is_sum = term.kind == Term::Kind::kSum;
    sum = SumOf(term.arguments[0], bindings);
    const GroundSum right = SumOf(term.arguments[1], bindings);
    const Interval& added = right.constant;
    sum.constant = EnclosingSum(sum.constant, is_sum ? added : -(added));
    for (const auto& [function, sign] : right.functions) {
      sum.functions.emplace_back(function, is_sum ? sign : -sign);
    }
  }
  return sum;
}

Bound TermGrounding::BoundOf(const Literal& literal, const Bindings& bindings) {
  return {FunctionOf(literal.arguments[0], bindings),
          literal.is_positive ? literal.relation : Complement(literal.relation),
          literal.arguments[1].value.low};
}

void TermGrounding::ForEachBinding(const std::vector<TypedName>& variables, Bindings& bindings,
                                   std::size_t from, const std::function<void()>& use) {
  if (from == 0 && !variables.empty()) CountInstances(variables);
  if (from == variables.size()) {
    use();
    return;
  }
  for (const std::string& constant : symbols_.ConstantsOf(variables[from].type)) {
    bindings.push_back({variables[from].name, {constant, FunctionId::None()}});
    ForEachBinding(variables, bindings, from + 1, use);
    bindings.pop_back();
  }
}

void TermGrounding::CountInstances(const std::vector<TypedName>& variables) {
  double ways = 1;
  for (const TypedName& variable : variables) {
    ways *= static_cast<double>(symbols_.ConstantsOf(variable.type).size());
  }
  instances_ += ways;
  if (instances_ > kMostInstances) {
    Fail(variables.front().place,
         fmt::format("{:.15g} instances, with those before {:.15g}", ways, instances_),
         fmt::format("{} of all effects and queries with variables", kMostInstances));
  }
}

void TermGrounding::CountBinding(Place place) {
  if (++bindings_ > kMostBindings) {
    Fail(place, "too many ways to bind the parameters of this action and those before it",
         fmt::format("at most {} bindings, whether the initial knowledge rules them out or not",
                     kMostBindings));
  }
}

}  // namespace assay::contingent
