#include "planner/algebra/normal_forms/expansion.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "planner/algebra/expression/evaluation.h"
#include "planner/algebra/expression/nodes.h"
#include "planner/algebra/normal_forms/sum_writer.h"
#include "planner/base/check.h"
#include "planner/base/intern_table.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {

namespace {

using Polynomial = PolynomialAlgebra::Polynomial;

bool IsExact(const Polynomial& a) {
  return std::ranges::all_of(a, [](const auto& term) { return IsSingle(term.coefficient); });
}

bool IsConstant(const Polynomial& a) { return a.empty() || (a.size() == 1 && a[0].monomial == 0); }

Interval ConstantIn(const Polynomial& a) { return a.empty() ? Interval{} : a[0].coefficient; }

}  // namespace

Expansion::Polynomial Expansion::Of(const Expression& e) {
  const std::vector<Expression> nodes = NodesOf(e);
  IndexMap<int> uses;  // by expression index: how often it is still needed
  for (const Expression& node : nodes) {
    for (const Expression& operand : node.operands()) ++uses[operand.index()];
  }
  for (const Expression& node : nodes) {
    Polynomial result = ExpandedNode(node);
    for (const Expression& operand : node.operands()) {
      if (--uses[operand.index()] == 0) expanded_[operand.index()] = {};
    }
    expanded_[node.index()] = std::move(result);
  }
  return std::move(expanded_[e.index()]);
}

const Expansion::Polynomial& Expansion::OfOneOfMany(const Expression& e) {
  // Nodes are expanded in the order in which they were created. Atoms are then numbered as they
  // would be for a single expression, and that number decides their order in the normal form.
  for (const Expression& node : UnexpandedNodesOf(e)) {
    Polynomial expanded = ExpandedNode(node);
    kept_terms_ += expanded.size() + 1;
    expanded_[node.index()] = std::move(expanded);
  }
  return *expanded_.Find(e.index());
}

Expression Expansion::WrittenOneOfMany(const Expression& e) {
  const auto [written, is_new] = written_.Insert(e.index());
  if (is_new) written = Written(OfOneOfMany(e));
  return written;
}

std::vector<Expression> Expansion::UnexpandedNodesOf(const Expression& e) const {
  std::vector<Expression> nodes;
  InternTable met;  // indices of `nodes`
  const auto meet = [&](const Expression& node) {
    if (expanded_.Find(node.index()) != nullptr) return;
    const std::uint64_t hash = MixedHash(0, node.index());
    if (met.Find(hash, [&](int i) { return nodes[i] == node; }) >= 0) return;
    met.Insert(hash, static_cast<int>(nodes.size()));
    nodes.push_back(node);
  };
  meet(e);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const Expression& operand : nodes[i].operands()) meet(operand);
  }
  std::ranges::sort(nodes, {}, &Expression::index);
  return nodes;
}

Expansion::Polynomial Expansion::ExpandedNode(const Expression& node) {
  Polynomial result = Expanded(node);
  if (arguments_ == AtomArguments::kRounded) {
    std::erase_if(result, [](const auto& term) { return IsRoundingAlone(term.coefficient); });
  }
  return result;
}

Expansion::Polynomial Expansion::Expanded(const Expression& e) {
  if (e.IsConstant()) return algebra_.Constant({e.constant(), e.constant()});
  if (e.op() == Operator::kVariable) return AtomPolynomial(e, 1);
  const auto expand = e.op().rule().expand;
  return expand != nullptr ? expand(*this, e) : FunctionOf(e);
}

std::vector<Expansion::Part> Expansion::PartsOf(std::span<const Expression> operands) {
  std::vector<Part> parts;
  parts.reserve(operands.size());
  for (const Expression& operand : operands) parts.push_back(PartOf(operand));
  return parts;
}

Expansion::Polynomial Expansion::SumOf(std::span<const Expression> terms) {
  std::vector<const Polynomial*> expanded;
  expanded.reserve(terms.size());
  for (const Expression& term : terms) expanded.push_back(PartOf(term).expanded);
  return algebra_.Sum(expanded);
}

Expansion::Polynomial Expansion::ProductOf(std::span<const Expression> factors) {
  return ProductOf(PartsOf(factors));
}

NormalForm Expansion::FormOf(Polynomial a) const {
  algebra_.Sort(a);
  NormalForm form;
  form.terms.reserve(a.size());
  for (const auto& [monomial, coefficient] : a) {
    NormalForm::Term& term = form.terms.emplace_back();
    term.coefficient = coefficient;
    term.factors.reserve(algebra_.Factors(monomial).size());
    for (const AtomPower& power : algebra_.Factors(monomial)) {
      term.factors.push_back(FactorOf(power));
    }
  }
  return form;
}

NormalForm::Factor Expansion::FactorOf(const AtomPower& power) const {
  return {.atom = *atoms_.Find(power.atom), .exponent = power.exponent};
}

Expression Expansion::Written(Polynomial a) const {
  algebra_.Sort(a);
  SumWriter writer;
  for (const auto& [monomial, coefficient] : a) {
    writer.BeginTerm(coefficient);
    for (const AtomPower& power : algebra_.Factors(monomial)) writer.Multiply(FactorOf(power));
  }
  const Expression e = writer.Finish();
  return e.pool() == nullptr ? pool_->Constant(e.constant()) : e;
}

// ---- Products and powers

Expansion::Polynomial Expansion::ProductOf(const std::vector<Part>& parts) {
  if (std::ranges::any_of(parts, [&](const Part& part) { return HoldsUnexpanded(part); })) {
    return Unexpanded(parts);
  }
  PolynomialAlgebra::Budget budget = NewBudget();
  std::optional<Polynomial> result = algebra_.Constant(kOne);
  for (const Part& part : parts) {
    result = algebra_.Product(*result, *part.expanded, budget);
    if (!result) return Unexpanded(parts);
  }
  return *std::move(result);
}

// Returns true if the factor is a product that was left unexpanded. Larger products with it are
// then left unexpanded, too.
bool Expansion::HoldsUnexpanded(const Part& part) const {
  if (part.expanded->size() != 1) return false;
  const auto factors = algebra_.Factors(part.expanded->front().monomial);
  return std::ranges::any_of(factors, [&](const AtomPower& factor) {
    const Expression& atom = *atoms_.Find(factor.atom);
    return atom.op() == Operator::kSum || (atom.op() == Operator::kPower && atom.exponent() > 0);
  });
}

// Returns the product as one term in which each sum is an atom.
Expansion::Polynomial Expansion::Unexpanded(const std::vector<Part>& parts) {
  Polynomial result = algebra_.Constant(kOne);
  for (const Part& part : parts) {
    if (part.expanded->empty()) return {};
    result[0] = algebra_.PlainProduct(result[0], TermFor(part));
  }
  return result;
}

PolynomialAlgebra::Term Expansion::TermFor(const Part& part) {
  return part.expanded->size() == 1 ? part.expanded->front()
                                    : AtomPolynomial(Argument(part), 1).front();
}

Expansion::Polynomial Expansion::PowerOf(const Expression& base, int exponent) {
  const Part part = PartOf(base);
  if (exponent > 0) return PositivePowerOf(part, exponent);
  const Polynomial reciprocal = ReciprocalOf(part);
  if (exponent == -1) return reciprocal;
  return PositivePowerOf({.written = Power(base, -1), .expanded = &reciprocal}, -exponent);
}

Expansion::Polynomial Expansion::PositivePowerOf(const Part& base, int exponent) {
  PolynomialAlgebra::Budget budget = NewBudget();
  if (auto power = algebra_.Power(*base.expanded, exponent, budget)) return *std::move(power);
  const Expression argument = Argument(base);
  // A sum is kept as a power of an atom, because no square of it has a replacement.
  if (argument.op() == Operator::kSum) return AtomPolynomial(argument, exponent);
  return AtomPolynomial(Power(argument, exponent), 1);
}

Expansion::Polynomial Expansion::QuotientOf(const Expression& a, const Expression& b) {
  const Polynomial reciprocal = ReciprocalOf(PartOf(b));
  const Expression written = pool_->Constant(1) / b;
  return ProductOf({PartOf(a), {.written = written, .expanded = &reciprocal}});
}

// Returns the reciprocal of `a`, which is a single term.
Expansion::Polynomial Expansion::ReciprocalOf(const Part& a) {
  if (a.expanded->size() == 1 && !Contains(a.expanded->front().coefficient, 0)) {
    return ReciprocalOfTerm(a.expanded->front());
  }
  const SignedArgument argument = ArgumentWithoutSign(a);
  return Signed(AtomPolynomial(Power(argument.expression, -1), 1), argument.sign);
}

Expansion::Polynomial Expansion::ReciprocalOfTerm(const PolynomialAlgebra::Term& term) {
  Polynomial result = algebra_.Constant(kOne / term.coefficient);
  for (const AtomPower& factor : algebra_.Factors(term.monomial)) {
    const Expression reciprocal = Power(*atoms_.Find(factor.atom), -1);
    const Polynomial power = AtomPolynomial(reciprocal, factor.exponent);
    result[0] = algebra_.PlainProduct(result[0], power[0]);
  }
  return result;
}

PolynomialAlgebra::Budget Expansion::NewBudget() const {
  return {.most_terms = most_terms_, .products = std::int64_t{100} * most_terms_};
}

// ---- Functions

Expansion::Polynomial Expansion::FunctionOf(const Expression& e) {
  const OperatorRule& rule = e.op().rule();
  const std::vector<Part> parts = PartsOf(e.operands());
  if (const std::optional<Interval> number = ValueOf(rule, parts)) {
    return algebra_.Constant(*number);
  }
  std::vector<Expression> arguments;
  arguments.reserve(parts.size());
  int sign = 1;
  for (const Part& part : parts) {
    const SignedArgument argument = ArgumentFor(rule.symmetry, part);
    if (rule.symmetry == Symmetry::kOdd) sign *= argument.sign;
    arguments.push_back(argument.expression);
  }
  if (rule.symmetry == Symmetry::kExchange) {
    if (arguments[0] == arguments[1]) return *parts[0].expanded;
    std::ranges::sort(arguments, {}, &Expression::index);
  }
  const Expression atom = Apply(e.op(), arguments);
  if (rule.square != nullptr) {
    auto [base, power] = rule.square(*this, atom, *parts[0].expanded);
    algebra_.ReplaceSquare(atom.index(), std::move(base), power);
  }
  return Signed(AtomPolynomial(atom, 1), sign);
}

// Returns the value of a function of numbers, if it has one.
std::optional<Interval> Expansion::ValueOf(const OperatorRule& rule,
                                           const std::vector<Part>& parts) {
  std::vector<Interval> numbers;
  for (const Part& part : parts) {
    if (!IsConstant(*part.expanded)) return std::nullopt;
    numbers.push_back(ConstantIn(*part.expanded));
  }
  const bool is_defined =
      rule.definedness == nullptr || rule.definedness(numbers, 0) == Definedness::kEverywhere;
  if (!is_defined) return std::nullopt;
  return rule.range(numbers, 0);
}

Expansion::Polynomial Expansion::OneMinusSquareOf(const Expression& atom) {
  const Polynomial square = AtomPolynomial(atom, 2);
  const Polynomial one = algebra_.Constant(kOne);
  const Polynomial minus_square = algebra_.Negated(square);
  return algebra_.Sum(std::array{&one, &minus_square});
}

Expansion::SignedArgument Expansion::ArgumentFor(Symmetry symmetry, const Part& a) const {
  switch (symmetry) {
    case Symmetry::kEven:
    case Symmetry::kOdd:
      return ArgumentWithoutSign(a);
    case Symmetry::kNone:
    case Symmetry::kExchange:
      return {.expression = Argument(a)};
  }
  ASSAY_CHECK(false, "no such symmetry");
}

Expansion::SignedArgument Expansion::ArgumentWithoutSign(const Part& a) const {
  if (!CanSimplify(a)) return {.expression = a.written};
  Polynomial sorted = *a.expanded;
  algebra_.Sort(sorted);
  const auto leading =
      std::ranges::find_if(sorted, [](const auto& term) { return term.monomial != 0; });
  if (leading == sorted.end() || leading->coefficient.low >= 0) {
    return {.expression = Written(sorted)};
  }
  return {.expression = Written(algebra_.Negated(std::move(sorted))), .sign = -1};
}

Expression Expansion::Argument(const Part& a) const {
  return CanSimplify(a) ? Written(*a.expanded) : a.written;
}

bool Expansion::CanSimplify(const Part& a) const {
  switch (arguments_) {
    case AtomArguments::kExact:
      return IsExact(*a.expanded);
    case AtomArguments::kRounded:
      return true;
  }
  return false;
}

Expansion::Polynomial Expansion::AtomPolynomial(const Expression& atom, int exponent) {
  atoms_[atom.index()] = atom;
  return algebra_.Atom(atom.index(), exponent);
}

Expansion::Polynomial Expansion::Signed(Polynomial a, int sign) const {
  return sign < 0 ? algebra_.Negated(std::move(a)) : a;
}

}  // namespace assay::algebra
