#include "planner/algebra/multiaffine/trigonometric_polynomial.h"

#include <cmath>
#include <complex>
#include <cstdint>

#include "planner/algebra/multiaffine/sector.h"

namespace assay::algebra {
namespace {

using Complex = std::complex<double>;

constexpr int kMostParts = 20'000;    // the most exponentials that all products may expand to
constexpr double kLeastTerm = 1e-16;  // relative to the largest: smaller terms are left out

// Writes products of cosines and sines as sums of exponentials exp(i turns . angles). The number of
// an exponential has its turns plus one as digits to the base three.
class ExponentialSum {
 public:
  explicit ExponentialSum(std::span<const int> cosines) : cosines_(cosines) {
    int count = 1;
    for (std::size_t i = 0; i < cosines.size(); ++i) {
      places_.push_back(count);
      still_ += count;
      count *= 3;
    }
    coefficients_.assign(static_cast<std::size_t>(count), 0);
  }

  // Returns false if the form has too many products.
  bool Add(const NestedForm& form) {
    Add(form, form.node_count() - 1);
    return parts_ <= kMostParts;
  }

  int still() const { return still_; }  // the number of the exponential exp(0)
  int place(std::size_t angle) const { return places_[angle]; }
  const std::vector<Complex>& coefficients() const { return coefficients_; }

 private:
  // Adds the node's sum times the atoms on the path to the node.
  void Add(const NestedForm& form, int node) {
    if (parts_ > kMostParts) return;
    AddProduct(form.constant(node));
    for (const auto& leaf : form.leaves(node)) {
      way_.push_back(leaf.atom);
      AddProduct(leaf.coefficient);
      way_.pop_back();
    }
    for (const auto& branch : form.branches(node)) {
      way_.push_back(branch.atom);
      Add(form, branch.node);
      way_.pop_back();
    }
  }

  void AddProduct(double coefficient) {
    parts_ += 1 << way_.size();
    if (coefficient != 0) AddProduct(coefficient, way_, still_);
  }

  void AddProduct(Complex coefficient, std::span<const int> atoms, int number) {
    if (atoms.empty()) {
      coefficients_[static_cast<std::size_t>(number)] += coefficient;
      return;
    }
    std::size_t angle = 0;
    while (atoms[0] != cosines_[angle] && atoms[0] != cosines_[angle] + 1) ++angle;
    const bool is_sine = atoms[0] != cosines_[angle];
    const Complex half = is_sine ? Complex(0, -0.5) : Complex(0.5, 0);
    AddProduct(coefficient * half, atoms.subspan(1), number + places_[angle]);
    AddProduct(coefficient * std::conj(half), atoms.subspan(1), number - places_[angle]);
  }

  std::span<const int> cosines_;
  std::vector<int> places_;  // the weights of the digits
  int still_ = 0;
  std::vector<Complex> coefficients_;
  std::vector<int> way_;
  int parts_ = 0;
};

Sector SumOfTurns(const std::array<signed char, TrigonometricPolynomial::kMostAngles>& turns,
                  double phase, std::span<const numeric::NearestInterval> box) {
  double low = phase;
  double high = phase;
  for (std::size_t i = 0; i < box.size(); ++i) {
    if (turns[i] == 0) continue;
    low += turns[i] > 0 ? box[i].low : -box[i].high;
    high += turns[i] > 0 ? box[i].high : -box[i].low;
  }
  return AngleBetween(low, high);
}

}  // namespace

bool TrigonometricPolynomial::Assign(const NestedForm& form, std::span<const int> cosines) {
  if (cosines.size() > kMostAngles) return false;
  ExponentialSum sum(cosines);
  if (!sum.Add(form)) return false;
  angle_count_ = static_cast<int>(cosines.size());
  constant_ = sum.coefficients()[static_cast<std::size_t>(sum.still())].real();
  left_out_ = 0;
  terms_.clear();
  double largest = 0;
  for (const Complex& coefficient : sum.coefficients()) {
    largest = std::max(largest, std::abs(coefficient));
  }
  // Each term is a cosine, which comes from two conjugate exponentials. The loop takes the
  // exponential in which the last of the turns that are not 0 is positive.
  for (std::size_t i = static_cast<std::size_t>(sum.still()) + 1; i < sum.coefficients().size();
       ++i) {
    const double amplitude = 2 * std::abs(sum.coefficients()[i]);
    if (amplitude <= kLeastTerm * largest) {
      left_out_ += amplitude;
      continue;
    }
    Term term = {.amplitude = amplitude, .phase = std::arg(sum.coefficients()[i])};
    for (std::size_t angle = 0; angle < cosines.size(); ++angle) {
      const std::size_t digit = i / static_cast<std::size_t>(sum.place(angle)) % 3;
      term.turns[angle] = static_cast<signed char>(static_cast<int>(digit) - 1);
    }
    terms_.push_back(term);
  }
  return true;
}

void TrigonometricEvaluation::Enter(const TrigonometricPolynomial& sum,
                                    std::span<const numeric::NearestInterval> box) {
  const int n = sum.angle_count_;
  range_ = sum.constant_;
  greatest_curvature_.Reset(n);
  slopes_.fill(0);
  least_curvature_.fill(0);
  for (const TrigonometricPolynomial::Term& term : sum.terms_) {
    const Sector sector =
        SumOfTurns(term.turns, term.phase, box.first(static_cast<std::size_t>(n)));
    const numeric::NearestInterval value = term.amplitude * Cosines(sector);
    const numeric::NearestInterval slope = -term.amplitude * Sines(sector);
    range_ += value;
    for (int i = 0; i < n; ++i) {
      const signed char turn = term.turns[static_cast<std::size_t>(i)];
      if (turn == 0) continue;
      slopes_[static_cast<std::size_t>(i)] += turn > 0 ? slope : -slope;
      least_curvature_[static_cast<std::size_t>(i)] -= value.high;
      for (int j = 0; j <= i; ++j) {
        greatest_curvature_(i, j) -= value.low * turn * term.turns[static_cast<std::size_t>(j)];
      }
    }
  }
}

}  // namespace assay::algebra
