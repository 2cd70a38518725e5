#include "planner/algebra/forms/normal_form.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

#include "planner/algebra/expression/index_map.h"
#include "planner/algebra/expression/intern_table.h"
#include "planner/algebra/forms/polynomial.h"
#include "planner/algebra/numeric/interval_arithmetic.h"

namespace assay::algebra {

namespace {

using Polynomial = PolynomialAlgebra::Polynomial;

bool IsExact(const Polynomial& a) {
  return std::ranges::all_of(a, [](const auto& term) { return IsSingle(term.coefficient); });
}

bool IsConstant(const Polynomial& a) { return a.empty() || (a.size() == 1 && a[0].monomial == 0); }

Interval ConstantIn(const Polynomial& a) { return a.empty() ? Interval{} : a[0].coefficient; }

// Returns atom^exponent. A power of a reciprocal is written as one negative power.
Expression PowerOfAtom(const NormalForm::Factor& factor) {
  const Expression& atom = factor.atom;
  const bool is_reciprocal = atom.op() == Operator::kPower && atom.exponent() == -1;
  return is_reciprocal ? Power(atom.operands()[0], -factor.exponent) : Power(atom, factor.exponent);
}

// Writes the terms of a normal form, one by one, as an expression.
class SumWriter {
 public:
  void BeginTerm(const Interval& coefficient) {
    EndTerm();
    factors_.assign(1, IsSingle(coefficient) ? coefficient.low : Midpoint(coefficient));
    is_rounding_alone_ = IsRoundingAlone(coefficient);
  }
  void Multiply(const NormalForm::Factor& factor) { factors_.push_back(PowerOfAtom(factor)); }

  Expression Finish() {
    EndTerm();
    return Sum(terms_);
  }

 private:
  void EndTerm() {
    if (!factors_.empty() && !is_rounding_alone_) terms_.push_back(Product(factors_));
  }

  std::vector<Expression> terms_;
  std::vector<Expression> factors_;  // factors of the current term
  bool is_rounding_alone_ = false;
};

}  // namespace

// Expands the nodes of expressions, one by one.
class Expansion {
 public:
  Expansion(ExpressionPool* pool, int most_terms, AtomArguments arguments)
      : pool_(pool), most_terms_(most_terms), arguments_(arguments) {}

  int most_terms() const { return most_terms_; }

  // Expands a single expression. The expansions of its sub-expressions are freed on the way.
  Polynomial Of(const Expression& e) { return Walked(e); }

  // Expands one of many expressions. The expansions of its sub-expressions are kept.
  const Polynomial& OfOneOfMany(const Expression& e) {
    ExpandAllOf(e);
    return *expanded_.Find(e.index());
  }
  // Returns the expansion of OfOneOfMany written as an expression, which is kept, too.
  Expression WrittenOneOfMany(const Expression& e) {
    const auto [written, is_new] = written_.Insert(e.index());
    if (is_new) written = Written(OfOneOfMany(e));
    return written;
  }
  std::size_t kept_terms() const { return kept_terms_; }

  NormalForm FormOf(Polynomial a) const {
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

  Expression Written(Polynomial a) const {
    algebra_.Sort(a);
    SumWriter writer;
    for (const auto& [monomial, coefficient] : a) {
      writer.BeginTerm(coefficient);
      for (const AtomPower& power : algebra_.Factors(monomial)) writer.Multiply(FactorOf(power));
    }
    const Expression e = writer.Finish();
    return e.pool() == nullptr ? pool_->Constant(e.constant()) : e;
  }

 private:
  // A factor of a product: the expression as it was written, and its expansion.
  struct Part {
    Expression written;
    const Polynomial* expanded = nullptr;
  };
  // Stands for sign * expression. The sign is chosen so that e and -e give the same expression.
  struct SignedArgument {
    Expression expression;
    int sign = 1;
  };

  // Expands nodes in the order in which they were created. Atoms are then numbered as they would be
  // for a single expression, and that number decides their order in the normal form.
  void ExpandAllOf(const Expression& e) {
    for (const Expression& node : UnexpandedNodesOf(e)) {
      Polynomial expanded = ExpandedNode(node);
      kept_terms_ += expanded.size() + 1;
      expanded_[node.index()] = std::move(expanded);
    }
  }

  std::vector<Expression> UnexpandedNodesOf(const Expression& e) const {
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

  Polynomial ExpandedNode(const Expression& node) {
    Polynomial result = Expanded(node);
    if (arguments_ == AtomArguments::kRounded) {
      std::erase_if(result, [](const auto& term) { return IsRoundingAlone(term.coefficient); });
    }
    return result;
  }

  Polynomial Walked(const Expression& e) {
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

  Part PartOf(const Expression& e) { return {.written = e, .expanded = expanded_.Find(e.index())}; }

  Polynomial Expanded(const Expression& e) {
    const auto operand = [&](std::size_t i) { return PartOf(e.operands()[i]); };
    switch (e.op()) {
      case Operator::kConstant:
        return algebra_.Constant({e.constant(), e.constant()});
      case Operator::kVariable:
        return AtomPolynomial(e, 1);
      case Operator::kSum:
        return SumOf(e.operands());
      case Operator::kProduct:
        return ProductOf(e.operands());
      case Operator::kPower:
        return PowerOf(operand(0), e.exponent());
      case Operator::kQuotient:
        return QuotientOf(operand(0), operand(1));
      case Operator::kSin:
        return SinOf(operand(0));
      case Operator::kCos:
        return CosOf(operand(0));
      case Operator::kSqrt:
        return SqrtOf(operand(0));
      case Operator::kAbs:
        return AbsOf(operand(0));
      case Operator::kMin:
        return ExtremeOf(operand(0), operand(1), &algebra::Min, &algebra::Min);
      case Operator::kMax:
        return ExtremeOf(operand(0), operand(1), &algebra::Max, &algebra::Max);
    }
    return {};
  }

  Polynomial SumOf(std::span<const Expression> terms) {
    std::vector<const Polynomial*> expanded;
    expanded.reserve(terms.size());
    for (const Expression& term : terms) expanded.push_back(PartOf(term).expanded);
    return algebra_.Sum(expanded);
  }

  Polynomial ProductOf(std::span<const Expression> factors) {
    std::vector<Part> parts;
    parts.reserve(factors.size());
    for (const Expression& factor : factors) parts.push_back(PartOf(factor));
    return ProductOf(parts);
  }

  Polynomial ProductOf(const std::vector<Part>& parts) {
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
  bool HoldsUnexpanded(const Part& part) const {
    if (part.expanded->size() != 1) return false;
    const auto factors = algebra_.Factors(part.expanded->front().monomial);
    return std::ranges::any_of(factors, [&](const AtomPower& factor) {
      const Expression& atom = *atoms_.Find(factor.atom);
      return atom.op() == Operator::kSum || (atom.op() == Operator::kPower && atom.exponent() > 0);
    });
  }

  // Returns the product as one term in which each sum is an atom.
  Polynomial Unexpanded(const std::vector<Part>& parts) {
    Polynomial result = algebra_.Constant(kOne);
    for (const Part& part : parts) {
      if (part.expanded->empty()) return {};
      result[0] = algebra_.PlainProduct(result[0], TermFor(part));
    }
    return result;
  }

  PolynomialAlgebra::Term TermFor(const Part& part) {
    return part.expanded->size() == 1 ? part.expanded->front()
                                      : AtomPolynomial(Argument(part), 1).front();
  }

  Polynomial PowerOf(const Part& base, int exponent) {
    if (exponent > 0) return PositivePowerOf(base, exponent);
    const Polynomial reciprocal = ReciprocalOf(base);
    if (exponent == -1) return reciprocal;
    const Expression written = Power(base.written, -1);
    return PositivePowerOf({.written = written, .expanded = &reciprocal}, -exponent);
  }

  Polynomial PositivePowerOf(const Part& base, int exponent) {
    PolynomialAlgebra::Budget budget = NewBudget();
    if (auto power = algebra_.Power(*base.expanded, exponent, budget)) return *std::move(power);
    const Expression argument = Argument(base);
    // A sum is kept as a power of an atom, because no square of it has a replacement.
    if (argument.op() == Operator::kSum) return AtomPolynomial(argument, exponent);
    return AtomPolynomial(Power(argument, exponent), 1);
  }

  Polynomial QuotientOf(const Part& a, const Part& b) {
    const Polynomial reciprocal = ReciprocalOf(b);
    const Expression written = pool_->Constant(1) / b.written;
    return ProductOf({a, {.written = written, .expanded = &reciprocal}});
  }

  // Returns the reciprocal of `a`, which is a single term.
  Polynomial ReciprocalOf(const Part& a) {
    if (a.expanded->size() == 1 && !Contains(a.expanded->front().coefficient, 0)) {
      return ReciprocalOfTerm(a.expanded->front());
    }
    const SignedArgument argument = ArgumentWithoutSign(a);
    return Signed(AtomPolynomial(Power(argument.expression, -1), 1), argument.sign);
  }

  Polynomial ReciprocalOfTerm(const PolynomialAlgebra::Term& term) {
    Polynomial result = algebra_.Constant(kOne / term.coefficient);
    for (const AtomPower& factor : algebra_.Factors(term.monomial)) {
      const Expression reciprocal = Power(*atoms_.Find(factor.atom), -1);
      const Polynomial power = AtomPolynomial(reciprocal, factor.exponent);
      result[0] = algebra_.PlainProduct(result[0], power[0]);
    }
    return result;
  }

  Polynomial SinOf(const Part& a) {
    if (IsConstant(*a.expanded)) return algebra_.Constant(Sin(ConstantIn(*a.expanded)));
    const SignedArgument argument = ArgumentWithoutSign(a);
    const Expression sine = Sin(argument.expression);
    const Polynomial cosine = AtomPolynomial(Cos(argument.expression), 2);
    const Polynomial one = algebra_.Constant(kOne);
    const Polynomial minus_cosine = algebra_.Negated(cosine);
    algebra_.ReplaceSquare(sine.index(), algebra_.Sum(std::array{&one, &minus_cosine}), 1);
    return Signed(AtomPolynomial(sine, 1), argument.sign);
  }

  Polynomial CosOf(const Part& a) {
    if (IsConstant(*a.expanded)) return algebra_.Constant(Cos(ConstantIn(*a.expanded)));
    return AtomPolynomial(Cos(ArgumentWithoutSign(a).expression), 1);
  }

  Polynomial SqrtOf(const Part& a) {
    if (IsConstant(*a.expanded) && ConstantIn(*a.expanded).low >= 0) {
      return algebra_.Constant(Sqrt(ConstantIn(*a.expanded)));
    }
    const Expression root = Sqrt(Argument(a));
    algebra_.ReplaceSquare(root.index(), *a.expanded, 1);
    return AtomPolynomial(root, 1);
  }

  Polynomial AbsOf(const Part& a) {
    if (IsConstant(*a.expanded)) return algebra_.Constant(Abs(ConstantIn(*a.expanded)));
    const Expression size = Abs(ArgumentWithoutSign(a).expression);
    algebra_.ReplaceSquare(size.index(), *a.expanded, 2);
    return AtomPolynomial(size, 1);
  }

  Polynomial ExtremeOf(const Part& a, const Part& b,
                       Interval (*of_numbers)(const Interval&, const Interval&),
                       Expression (*of_expressions)(const Expression&, const Expression&)) {
    if (IsConstant(*a.expanded) && IsConstant(*b.expanded)) {
      return algebra_.Constant(of_numbers(ConstantIn(*a.expanded), ConstantIn(*b.expanded)));
    }
    Expression first = Argument(a);
    Expression second = Argument(b);
    if (first == second) return *a.expanded;
    if (second.index() < first.index()) std::swap(first, second);
    return AtomPolynomial(of_expressions(first, second), 1);
  }

  PolynomialAlgebra::Budget NewBudget() const {
    return {.most_terms = most_terms_, .products = std::int64_t{100} * most_terms_};
  }

  Polynomial AtomPolynomial(const Expression& atom, int exponent) {
    atoms_[atom.index()] = atom;
    return algebra_.Atom(atom.index(), exponent);
  }

  Polynomial Signed(Polynomial a, int sign) const {
    return sign < 0 ? algebra_.Negated(std::move(a)) : a;
  }

  bool CanSimplify(const Part& a) const {
    switch (arguments_) {
      case AtomArguments::kExact:
        return IsExact(*a.expanded);
      case AtomArguments::kRounded:
        return true;
    }
    return false;
  }

  Expression Argument(const Part& a) const {
    return CanSimplify(a) ? Written(*a.expanded) : a.written;
  }

  SignedArgument ArgumentWithoutSign(const Part& a) const {
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

  NormalForm::Factor FactorOf(const AtomPower& power) const {
    return {.atom = *atoms_.Find(power.atom), .exponent = power.exponent};
  }

  ExpressionPool* const pool_;
  const int most_terms_;
  const AtomArguments arguments_;
  PolynomialAlgebra algebra_;
  IndexMap<Expression> atoms_;
  IndexMap<Polynomial> expanded_;
  IndexMap<Expression> written_;
  std::size_t kept_terms_ = 0;
};

class KeptNormalForms {
 public:
  Expansion& ExpansionFor(const Expression& e, int most_terms, AtomArguments arguments) {
    std::optional<Expansion>& kept = arguments == AtomArguments::kExact ? exact_ : rounded_;
    const bool is_full = kept && kept->kept_terms() > kMostTerms;
    if (!kept || is_full || kept->most_terms() != most_terms) {
      kept.emplace(e.pool(), most_terms, arguments);
    }
    return *kept;
  }

 private:
  static constexpr std::size_t kMostTerms = 1'000'000;  // about 30 MB

  std::optional<Expansion> exact_;
  std::optional<Expansion> rounded_;
};

void KeepNormalForms(ExpressionPool& pool) {
  pool.kept_normal_forms_ = std::make_shared<KeptNormalForms>();
}

NormalForm NormalFormOf(const Expression& e, int most_terms, AtomArguments arguments) {
  if (e.IsConstant(0)) return {};
  if (e.IsConstant()) {
    return {.terms = {{.coefficient = {e.constant(), e.constant()}, .factors = {}}}};
  }
  if (KeptNormalForms* const kept = e.pool()->kept_normal_forms()) {
    Expansion& many = kept->ExpansionFor(e, most_terms, arguments);
    return many.FormOf(many.OfOneOfMany(e));
  }
  Expansion one(e.pool(), most_terms, arguments);
  return one.FormOf(one.Of(e));
}

Expression SimplifiedExpression(const Expression& e, int most_terms) {
  if (e.IsConstant()) return e;
  if (KeptNormalForms* const kept = e.pool()->kept_normal_forms()) {
    return kept->ExpansionFor(e, most_terms, AtomArguments::kRounded).WrittenOneOfMany(e);
  }
  Expansion one(e.pool(), most_terms, AtomArguments::kRounded);
  return one.Written(one.Of(e));
}

bool IsRoundingAlone(const Interval& coefficient) {
  return !IsSingle(coefficient) && Contains(coefficient, 0);
}

Expression ToExpression(const NormalForm& form) {
  SumWriter writer;
  for (const NormalForm::Term& term : form.terms) {
    writer.BeginTerm(term.coefficient);
    for (const NormalForm::Factor& factor : term.factors) writer.Multiply(factor);
  }
  return writer.Finish();
}

}  // namespace assay::algebra
