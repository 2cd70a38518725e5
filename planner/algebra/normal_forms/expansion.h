#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "planner/algebra/expression/expression.h"
#include "planner/algebra/normal_forms/normal_form.h"
#include "planner/algebra/normal_forms/polynomial.h"
#include "planner/algebra/operators/operator_rule.h"
#include "planner/base/index_map.h"

namespace assay::algebra {

// Expands the nodes of expressions, one by one, as polynomials in atoms. The operations below are
// for the rules of operators, which say how a node is expanded after its operands have been
// expanded.
class Expansion {
 public:
  using Polynomial = PolynomialAlgebra::Polynomial;

  Expansion(ExpressionPool* pool, int most_terms, AtomArguments arguments)
      : pool_(pool), most_terms_(most_terms), arguments_(arguments) {}

  int most_terms() const { return most_terms_; }

  // Expands a single expression. The expansions of its sub-expressions are freed on the way.
  Polynomial Of(const Expression& e);

  // Expands one of many expressions. The expansions of its sub-expressions are kept.
  const Polynomial& OfOneOfMany(const Expression& e);
  // Returns the expansion of OfOneOfMany written as an expression. The expression is kept as well.
  Expression WrittenOneOfMany(const Expression& e);
  std::size_t kept_terms() const { return kept_terms_; }

  NormalForm FormOf(Polynomial a) const;
  Expression Written(Polynomial a) const;

  // The expansion of an operation whose operands are expanded already.
  Polynomial SumOf(std::span<const Expression> terms);
  Polynomial ProductOf(std::span<const Expression> factors);
  Polynomial PowerOf(const Expression& base, int exponent);
  Polynomial QuotientOf(const Expression& a, const Expression& b);

  // Returns 1 - atom^2.
  Polynomial OneMinusSquareOf(const Expression& atom);

 private:
  // An operand: the expression as it was written, and its expansion.
  struct Part {
    Expression written;
    const Polynomial* expanded = nullptr;
  };
  // Stands for sign * expression. The sign is chosen so that e and -e give the same expression.
  struct SignedArgument {
    Expression expression;
    int sign = 1;
  };

  std::vector<Expression> UnexpandedNodesOf(const Expression& e) const;
  Polynomial ExpandedNode(const Expression& node);
  Polynomial Expanded(const Expression& e);
  Part PartOf(const Expression& e) { return {.written = e, .expanded = expanded_.Find(e.index())}; }
  std::vector<Part> PartsOf(std::span<const Expression> operands);

  // Products and powers
  Polynomial ProductOf(const std::vector<Part>& parts);
  bool HoldsUnexpanded(const Part& part) const;
  Polynomial Unexpanded(const std::vector<Part>& parts);
  PolynomialAlgebra::Term TermFor(const Part& part);
  Polynomial PositivePowerOf(const Part& base, int exponent);
  Polynomial ReciprocalOf(const Part& a);
  Polynomial ReciprocalOfTerm(const PolynomialAlgebra::Term& term);
  PolynomialAlgebra::Budget NewBudget() const;

  // Functions
  Polynomial FunctionOf(const Expression& e);
  static std::optional<Interval> ValueOf(const OperatorRule& rule, const std::vector<Part>& parts);
  SignedArgument ArgumentFor(Symmetry symmetry, const Part& a) const;
  Polynomial AtomPolynomial(const Expression& atom, int exponent);
  bool CanSimplify(const Part& a) const;
  Expression Argument(const Part& a) const;
  SignedArgument ArgumentWithoutSign(const Part& a) const;
  Polynomial Signed(Polynomial a, int sign) const;
  NormalForm::Factor FactorOf(const AtomPower& power) const;

  ExpressionPool* const pool_;
  const int most_terms_;
  const AtomArguments arguments_;
  PolynomialAlgebra algebra_;
  IndexMap<Expression> atoms_;
  IndexMap<Polynomial> expanded_;
  IndexMap<Expression> written_;
  std::size_t kept_terms_ = 0;
};

}  // namespace assay::algebra
