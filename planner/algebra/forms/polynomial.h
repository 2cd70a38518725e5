#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "planner/algebra/expression/intern_table.h"
#include "planner/base/interval.h"

namespace assay::algebra {

// A power of an atom, which here is no more than a number.
struct AtomPower {
  int atom = 0;
  int exponent = 1;  // positive

  auto operator<=>(const AtomPower&) const = default;
};

// Sums of products of powers of atoms, with intervals for numbers; every operation's result holds
// the values of its operands' results. Monomials (products of powers) are stored once each. The
// squares of some atoms can be replaced by polynomials, and always are: sin^2 by 1 - cos^2.
class PolynomialAlgebra {
 public:
  struct Term {
    int monomial = 0;  // 0: the empty product
    Interval coefficient;
  };
  using Polynomial = std::vector<Term>;  // distinct monomials, no exact 0 before them

  // What an expansion may cost at most; spent by the operations.
  struct Budget {
    int most_terms = 0;         // of any result
    std::int64_t products = 0;  // of two terms each
  };

  PolynomialAlgebra();

  Polynomial Constant(const Interval& value) const;
  Polynomial Atom(int atom, int exponent);
  std::span<const AtomPower> Factors(int monomial) const { return monomials_[monomial]; }

  // From now on atom^2 = base^power; power is 1 or 2, and base knows nothing of the atom.
  void ReplaceSquare(int atom, Polynomial base, int power);

  Polynomial Sum(std::span<const Polynomial* const> terms);
  Polynomial Negated(Polynomial a) const;
  // Nothing if the budget does not suffice.
  std::optional<Polynomial> Product(const Polynomial& a, const Polynomial& b, Budget& budget);
  std::optional<Polynomial> Power(const Polynomial& a, int n, Budget& budget);  // n > 0
  // Of two single terms, squares left as they are.
  Term PlainProduct(const Term& a, const Term& b);

  // Terms by their factors, lexicographically: the constant first.
  void Sort(Polynomial& a) const;

 private:
  struct Square {
    Polynomial base;
    int power = 1;
  };
  using Factorization = std::vector<AtomPower>;
  class TermCollector;

  int Intern(const Factorization& factors);
  // The product of two monomials; none if it has a square that is replaced.
  std::optional<int> PlainProduct(int a, int b);
  static Factorization Merged(std::span<const AtomPower> a, std::span<const AtomPower> b);
  bool HasReplacedSquare(const Factorization& factors) const;
  std::optional<Polynomial> Reduced(const Factorization& factors, Budget& budget);
  std::optional<Polynomial> PowerOfTerm(const Term& a, int n, Budget& budget);

  std::vector<Factorization> monomials_;
  InternTable table_;
  std::unordered_map<int, Square> squares_;
  // Products of two monomials that were asked for.
  struct KnownProduct {
    int a = 0;
    int b = 0;
    std::optional<int> product = {};
  };
  std::vector<KnownProduct> products_;
  InternTable product_table_;
  // Scratch of sums in the making, one inside another: the places of their terms by monomial, all
  // -1 between uses.
  std::vector<std::vector<int>> idle_places_;
};

}  // namespace assay::algebra
