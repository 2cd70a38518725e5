#include "planner/algebra/normal_forms/polynomial.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "planner/base/check.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {

namespace {

using Polynomial = PolynomialAlgebra::Polynomial;

constexpr int kLargestExponent = 1'000'000;

std::uint64_t HashOf(std::span<const AtomPower> factors) {
  std::uint64_t hash = factors.size();
  for (const AtomPower& factor : factors) {
    hash = MixedHash(hash, static_cast<std::uint64_t>(factor.atom) << 32U |
                               static_cast<std::uint32_t>(factor.exponent));
  }
  return hash;
}

}  // namespace

// Collects terms and merges those with equal monomials.
class PolynomialAlgebra::TermCollector {
 public:
  TermCollector(std::vector<std::vector<int>>& idle_places, std::size_t expected)
      : idle_places_(idle_places) {
    terms_.reserve(expected);
    if (idle_places_.empty()) return;
    places_ = std::move(idle_places_.back());
    idle_places_.pop_back();
  }
  TermCollector(const TermCollector&) = delete;
  TermCollector& operator=(const TermCollector&) = delete;
  ~TermCollector() {
    ForgetPlaces();
    idle_places_.push_back(std::move(places_));
  }

  void Add(int monomial, const Interval& coefficient) {
    const auto index = static_cast<std::size_t>(monomial);
    if (index >= places_.size()) places_.resize(2 * index + 1, -1);
    int& place = places_[index];
    if (place < 0) {
      place = static_cast<int>(terms_.size());
      terms_.push_back({monomial, coefficient});
    } else {
      terms_[place].coefficient = terms_[place].coefficient + coefficient;
    }
  }

  std::size_t size() const { return terms_.size(); }

  Polynomial Finish() {
    ForgetPlaces();
    std::erase_if(terms_, [](const Term& term) { return term.coefficient == Interval{}; });
    return std::move(terms_);
  }

 private:
  void ForgetPlaces() {
    for (const Term& term : terms_) places_[term.monomial] = -1;
  }

  std::vector<std::vector<int>>& idle_places_;
  std::vector<int> places_;
  Polynomial terms_;
};

PolynomialAlgebra::PolynomialAlgebra() { Intern({}); }

Polynomial PolynomialAlgebra::Constant(const Interval& value) const {
  if (value == Interval{}) return {};
  return {{.monomial = 0, .coefficient = value}};
}

Polynomial PolynomialAlgebra::Atom(int atom, int exponent) {
  return {{.monomial = Intern({{atom, exponent}}), .coefficient = kOne}};
}

void PolynomialAlgebra::ReplaceSquare(int atom, Polynomial base, int power) {
  squares_.try_emplace(atom, Square{.base = std::move(base), .power = power});
}

Polynomial PolynomialAlgebra::Sum(std::span<const Polynomial* const> terms) {
  std::size_t most = 0;
  for (const Polynomial* polynomial : terms) most += polynomial->size();
  TermCollector collector(idle_places_, most);
  for (const Polynomial* polynomial : terms) {
    for (const Term& term : *polynomial) collector.Add(term.monomial, term.coefficient);
  }
  return collector.Finish();
}

Polynomial PolynomialAlgebra::Negated(Polynomial a) const {
  for (Term& term : a) term.coefficient = -term.coefficient;
  return a;
}

std::optional<Polynomial> PolynomialAlgebra::Product(const Polynomial& a, const Polynomial& b,
                                                     Budget& budget) {
  budget.products -= static_cast<std::int64_t>(a.size()) * static_cast<std::int64_t>(b.size());
  if (budget.products < 0) return std::nullopt;
  TermCollector collector(idle_places_, std::max(a.size(), b.size()));
  for (const Term& x : a) {
    for (const Term& y : b) {
      const Interval coefficient = x.coefficient * y.coefficient;
      if (const std::optional<int> plain = PlainProduct(x.monomial, y.monomial)) {
        collector.Add(*plain, coefficient);
      } else {
        const auto reduced = Reduced(Merged(Factors(x.monomial), Factors(y.monomial)), budget);
        if (!reduced) return std::nullopt;
        for (const Term& term : *reduced) {
          collector.Add(term.monomial, coefficient * term.coefficient);
        }
      }
      if (collector.size() > static_cast<std::size_t>(budget.most_terms)) return std::nullopt;
    }
  }
  return collector.Finish();
}

std::optional<Polynomial> PolynomialAlgebra::Power(const Polynomial& a, int n, Budget& budget) {
  if (a.size() == 1) return PowerOfTerm(a[0], n, budget);
  std::optional<Polynomial> result = a;
  for (int i = 1; i < n && result && !result->empty(); ++i) result = Product(*result, a, budget);
  return result;
}

PolynomialAlgebra::Term PolynomialAlgebra::PlainProduct(const Term& a, const Term& b) {
  return {.monomial = Intern(Merged(Factors(a.monomial), Factors(b.monomial))),
          .coefficient = a.coefficient * b.coefficient};
}

void PolynomialAlgebra::Sort(Polynomial& a) const {
  std::ranges::sort(a, [&](const Term& x, const Term& y) {
    return monomials_[x.monomial] < monomials_[y.monomial];
  });
}

int PolynomialAlgebra::Intern(const Factorization& factors) {
  const std::uint64_t hash = HashOf(factors);
  const int known = table_.Find(hash, [&](int i) { return monomials_[i] == factors; });
  if (known >= 0) return known;
  monomials_.push_back(factors);
  table_.Insert(hash, static_cast<int>(monomials_.size()) - 1);
  return static_cast<int>(monomials_.size()) - 1;
}

std::optional<int> PolynomialAlgebra::PlainProduct(int a, int b) {
  const std::uint64_t hash =
      MixedHash(0, static_cast<std::uint64_t>(a) << 32U | static_cast<std::uint32_t>(b));
  const int known =
      product_table_.Find(hash, [&](int i) { return products_[i].a == a && products_[i].b == b; });
  if (known >= 0) return products_[known].product;
  const Factorization factors = Merged(Factors(a), Factors(b));
  std::optional<int> product;
  if (!HasReplacedSquare(factors)) product = Intern(factors);
  products_.push_back({a, b, product});
  product_table_.Insert(hash, static_cast<int>(products_.size()) - 1);
  return product;
}

PolynomialAlgebra::Factorization PolynomialAlgebra::Merged(std::span<const AtomPower> a,
                                                           std::span<const AtomPower> b) {
  Factorization merged;
  merged.reserve(a.size() + b.size());
  auto x = a.begin();
  auto y = b.begin();
  while (x != a.end() && y != b.end()) {
    if (x->atom == y->atom) {
      ASSAY_CHECK(x->exponent <= std::numeric_limits<int>::max() - y->exponent,
                  "an exponent exceeds all bounds");
      merged.push_back({x->atom, x->exponent + y->exponent});
      ++x;
      ++y;
    } else {
      merged.push_back(x->atom < y->atom ? *x++ : *y++);
    }
  }
  merged.insert(merged.end(), x, a.end());
  merged.insert(merged.end(), y, b.end());
  return merged;
}

bool PolynomialAlgebra::HasReplacedSquare(const Factorization& factors) const {
  return std::ranges::any_of(factors, [&](const AtomPower& factor) {
    return factor.exponent > 1 && squares_.contains(factor.atom);
  });
}

// Returns the monomial with every replaceable square substituted.
std::optional<Polynomial> PolynomialAlgebra::Reduced(const Factorization& factors, Budget& budget) {
  Factorization kept;
  Factorization replaced;  // the powers to be replaced, with halved exponents
  for (const AtomPower& factor : factors) {
    if (factor.exponent == 1 || !squares_.contains(factor.atom)) {
      kept.push_back(factor);
      continue;
    }
    replaced.push_back({factor.atom, factor.exponent / 2});
    if (factor.exponent % 2 != 0) kept.push_back({factor.atom, 1});
  }
  std::optional<Polynomial> result = Polynomial{{.monomial = Intern(kept), .coefficient = kOne}};
  for (const auto& [atom, half] : replaced) {
    const Square& square = squares_.at(atom);
    const auto power = Power(square.base, square.power * half, budget);
    if (!power) return std::nullopt;
    result = Product(*result, *power, budget);
    if (!result) return std::nullopt;
  }
  return result;
}

std::optional<Polynomial> PolynomialAlgebra::PowerOfTerm(const Term& a, int n, Budget& budget) {
  Factorization factors(Factors(a.monomial).begin(), Factors(a.monomial).end());
  for (AtomPower& factor : factors) {
    if (std::int64_t{factor.exponent} * n > kLargestExponent) return std::nullopt;
    factor.exponent *= n;
  }
  std::optional<Polynomial> result = Reduced(factors, budget);
  if (!result) return std::nullopt;
  const Interval coefficient = assay::Power(a.coefficient, n);
  for (Term& term : *result) term.coefficient = term.coefficient * coefficient;
  return result;
}

}  // namespace assay::algebra
