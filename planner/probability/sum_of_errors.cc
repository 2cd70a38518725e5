#include "planner/probability/sum_of_errors.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "planner/numeric/interval_arithmetic.h"

namespace assay::probability {
namespace {

constexpr int kCells = 4096;  // of the sum of all ranges

// Probabilities of numbers on a lattice: first, first + cell, first + 2 cells, ...
struct Lattice {
  double first = 0;
  std::vector<double> probabilities = {1};

  void Add(double others_first, const std::vector<double>& others) {
    first += others_first;
    std::vector<double> sum(probabilities.size() + others.size() - 1, 0);
    for (std::size_t i = 0; i < probabilities.size(); ++i) {
      for (std::size_t k = 0; k < others.size(); ++k) sum[i + k] += probabilities[i] * others[k];
    }
    probabilities = std::move(sum);
  }
};

// Returns the probability that a normal number with this deviation is more than `value`. With the
// deviation 0, the number is 0.
double NormalBeyond(double value, double deviation) {
  if (deviation == 0) return value < 0 ? 1 : 0;
  return StandardNormalAtMost(-value / deviation);
}

// Returns the probability that the lattice's number plus a normal number is more than `limit`.
double Beyond(const Lattice& lattice, double cell, double limit, double deviation) {
  double probability = 0;
  for (std::size_t i = 0; i < lattice.probabilities.size(); ++i) {
    const double number = lattice.first + static_cast<double>(i) * cell;
    probability += lattice.probabilities[i] * NormalBeyond(limit - number, deviation);
  }
  return probability;
}

// Rounding errors of some thousand sums and products of positive numbers are far below this share.
constexpr double kRoundingShare = 1e-10;
// Each probability of a cell is a difference of two numbers up to 1.
constexpr double kRoundingOfCell = 4e-16;
// Rounding errors of the lattice's numbers are far below this share of the width of all ranges.
constexpr double kRoundingOfNumbers = 1e-12;

}  // namespace

Interval SumOfErrors::Term::range() const {
  return factor < 0 ? Interval{factor * distribution.range.high, factor * distribution.range.low}
                    : Interval{factor * distribution.range.low, factor * distribution.range.high};
}

double SumOfErrors::Term::AtMost(double value) const {
  return factor < 0 ? 1 - distribution.AtMost(value / factor) : distribution.AtMost(value / factor);
}

void SumOfErrors::Add(double factor, const ErrorDistribution& distribution) {
  if (factor == 0) return;
  if (distribution.shape == ErrorDistribution::Shape::kNormal && !distribution.IsCutOff()) {
    variance_ += std::pow(factor * distribution.deviation, 2);
  } else {
    terms_.push_back({factor, distribution});
  }
}

std::vector<double> SumOfErrors::Term::OnLattice(double cell) const {
  const auto cells = static_cast<int>(std::ceil(Width(range()) / cell));
  std::vector<double> probabilities;
  double below = 0;
  for (int i = 1; i <= cells; ++i) {
    const double at_most = i == cells ? 1 : AtMost(range().low + i * cell);
    probabilities.push_back(std::max(0., at_most - below));
    below = at_most;
  }
  return probabilities;
}

Interval SumOfErrors::Beyond(double limit) const {
  double width = 0;
  for (const Term& term : terms_) width += Width(term.range());
  const double cell = width / kCells;
  Lattice lattice;
  for (const Term& term : terms_) lattice.Add(term.range().low, term.OnLattice(cell));
  const double deviation = std::sqrt(variance_);
  const double slack = kRoundingOfNumbers * width;
  const double moved = static_cast<double>(terms_.size()) * cell;
  const double least = probability::Beyond(lattice, cell, limit + slack, deviation);
  const double most = probability::Beyond(lattice, cell, limit - moved - slack, deviation);
  const double rounding = static_cast<double>(terms_.size()) * kCells * kRoundingOfCell;
  return {std::max(0., least * (1 - kRoundingShare) - rounding),
          std::min(1., most * (1 + kRoundingShare) + rounding)};
}

}  // namespace assay::probability
