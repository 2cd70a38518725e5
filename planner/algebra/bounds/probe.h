#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "planner/algebra/bounds/maximization.h"
#include "planner/algebra/forms/derivatives.h"

namespace assay::algebra {

using Box = std::vector<Interval>;  // by the variables' numbers in a Maximization

// Everything that is learned about a maximization by evaluating it: over boxes, at points; and the
// best feasible point so far. Counts the evaluations.
class Probe {
 public:
  explicit Probe(const Maximization& problem);

  const Maximization& problem() const { return problem_; }
  std::int64_t evaluations() const { return evaluations_; }

  // Over a box, outward-rounded.
  Interval Range(std::span<const Interval> box);
  Derivatives<Interval>& over_box() { return over_box_; }  // of the last range
  Interval RangeAt(std::span<const double> point);         // the box that holds this point alone
  bool SurelyInfeasible(std::span<const Interval> box);    // an inequality holds nowhere in it

  // At a point, in doubles.
  double Value(std::span<const double> point);
  Derivatives<double>& at_point() { return at_point_; }  // of the last value
  const std::vector<double>& Gradient();
  const std::vector<Interval>& GradientOverBox();
  void CountSecondDerivatives() { ++evaluations_; }
  std::int64_t splits() const { return splits_; }
  void CountSplit() { ++splits_; }

  std::vector<Derivatives<double>>& slacks_at_point() { return slacks_at_point_; }

  // Keeps the point if it surely satisfies the inequalities and attains more than the best so far;
  // tells whether it did.
  bool Offer(std::span<const double> point);
  bool SurelyFeasible(std::span<const double> point);
  bool has_best() const { return best_value_ > -std::numeric_limits<double>::infinity(); }
  const std::vector<double>& best_point() const { return best_point_; }
  // No more than the expression attains there; -infinity if there is no point.
  double best_value() const { return best_value_; }

 private:
  const Box& BoxOf(std::span<const double> point);
  bool IsDefinedAsWritten(std::span<const double> point);

  const Maximization& problem_;
  Derivatives<Interval> over_box_;
  Derivatives<double> at_point_;
  std::vector<Derivatives<Interval>> slacks_;
  std::vector<Derivatives<double>> slacks_at_point_;
  std::optional<Derivatives<Interval>> as_written_;
  Box point_box_;
  std::vector<double> best_point_;
  double best_value_ = -std::numeric_limits<double>::infinity();
  std::int64_t evaluations_ = 0;
  std::int64_t splits_ = 0;
};

// Each variable's midpoint.
std::vector<double> CentreOf(std::span<const Interval> box);

}  // namespace assay::algebra
