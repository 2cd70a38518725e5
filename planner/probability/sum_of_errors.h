#pragma once

#include <vector>

#include "planner/base/interval.h"
#include "planner/probability/error_distribution.h"

namespace assay::probability {

// A sum of independent errors, each times a number.
//
// Normal distributions that are not cut off add up to one normal distribution. All others are
// replaced by numbers on a lattice: the probability of each cell is moved to one end of the cell.
// The sum of the moved errors is less than the true sum by at most one cell for each error. Its
// distribution is the convolution of theirs, so it bounds the true distribution from both sides.
class SumOfErrors {
 public:
  // Adds an independent error times `factor`.
  void Add(double factor, const ErrorDistribution& distribution);
  // Adds a normal distribution with this variance, for example of errors that are correlated with
  // each other.
  void AddVariance(double variance) { variance_ += variance; }

  // Returns bounds of the probability that the sum is more than `limit`.
  Interval Beyond(double limit) const;

 private:
  struct Term {
    double factor;
    ErrorDistribution distribution;

    Interval range() const;
    // Returns the probability that the term is at most `value`.
    double AtMost(double value) const;
    // Returns the probability of each cell of the range, whose last cell may be cut off.
    std::vector<double> OnLattice(double cell) const;
  };

  std::vector<Term> terms_;  // finite ranges only
  double variance_ = 0;      // of the normal distribution that they are added to
};

}  // namespace assay::probability
