#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "planner/base/intern_table.h"
#include "planner/base/interval.h"

namespace assay::algebra {

// A power of an atom. An atom is represented by a number alone.
struct AtomPower {
  int atom = 0;
  int exponent = 1;  // positive

  auto operator<=>(const AtomPower&) const = default;
};

// Sums of products of powers of atoms, with intervals as coefficients. The result of an operation
// contains the results for all values of its operands. Each monomial (product of powers) is stored
// once. The square of an atom can be given a replacement polynomial, which is then always
// substituted: sin^2 becomes 1 - cos^2.
class PolynomialAlgebra {
 public:
  struct Term {
    int monomial = 0;  // 0 stands for the empty product
    Interval coefficient;
  };
  using Polynomial = std::vector<Term>;  // distinct monomials, no coefficient that is exactly 0

  // The greatest cost of an expansion. Operations subtract from it.
  struct Budget {
    int most_terms = 0;         // the most terms of any result
    std::int64_t products = 0;  // the number of products of two terms
  };

  PolynomialAlgebra();

  Polynomial Constant(const Interval& value) const;
  Polynomial Atom(int atom, int exponent);
  std::span<const AtomPower> Factors(int monomial) const { return monomials_[monomial]; }

  // From this call on, atom^2 is replaced by base^power. The power is 1 or 2, and `base` must not
  // contain the atom.
  void ReplaceSquare(int atom, Polynomial base, int power);

  Polynomial Sum(std::span<const Polynomial* const> terms);
  Polynomial Negated(Polynomial a) const;
  // Product and Power return nothing if the budget does not suffice.
  std::optional<Polynomial> Product(const Polynomial& a, const Polynomial& b, Budget& budget);
  std::optional<Polynomial> Power(const Polynomial& a, int n, Budget& budget);  // n > 0
  // Returns the product of two single terms, without replacing squares.
  Term PlainProduct(const Term& a, const Term& b);

  // Sorts terms lexicographically by their factors. The constant term comes first.
  void Sort(Polynomial& a) const;

 private:
  struct Square {
    Polynomial base;
    int power = 1;
  };
  using Factorization = std::vector<AtomPower>;
  class TermCollector;

  int Intern(const Factorization& factors);
  // Returns the product of two monomials, or nothing if it contains a square that has a
  // replacement.
  std::optional<int> PlainProduct(int a, int b);
  static Factorization Merged(std::span<const AtomPower> a, std::span<const AtomPower> b);
  bool HasReplacedSquare(const Factorization& factors) const;
  std::optional<Polynomial> Reduced(const Factorization& factors, Budget& budget);
  std::optional<Polynomial> PowerOfTerm(const Term& a, int n, Budget& budget);

  std::vector<Factorization> monomials_;
  InternTable table_;
  std::unordered_map<int, Square> squares_;
  // A product of two monomials that was computed before.
  struct KnownProduct {
    int a = 0;
    int b = 0;
    std::optional<int> product = {};
  };
  std::vector<KnownProduct> products_;
  InternTable product_table_;
  // Scratch memory for nested sums under construction: the places of their terms by monomial. All
  // entries are -1 between uses.
  std::vector<std::vector<int>> idle_places_;
};

}  // namespace assay::algebra
