#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "planner/algebra/bounds/maximization.h"
#include "planner/algebra/compiled_forms/derivatives.h"

namespace assay::algebra {

using Box = std::vector<Interval>;  // indexed by the variables' numbers in a Maximization

// Evaluates a maximization over boxes and at points. It counts the evaluations and keeps the best
// feasible point.
class Probe {
 public:
  explicit Probe(const Maximization& problem);

  const Maximization& problem() const { return problem_; }
  std::int64_t evaluations() const { return evaluations_; }

  // Evaluates over a box, rounded outward.
  Interval Range(std::span<const Interval> box);
  Derivatives<Interval>& over_box() { return over_box_; }  // derivatives over the last box
  // Evaluates over the box that contains this point alone.
  Interval RangeAt(std::span<const double> point);
  // Returns true if some inequality holds nowhere in the box.
  bool SurelyInfeasible(std::span<const Interval> box);

  // Evaluates at a point, in doubles.
  double Value(std::span<const double> point);
  Derivatives<double>& at_point() { return at_point_; }  // derivatives at the last point
  const std::vector<double>& Gradient();
  const std::vector<Interval>& GradientOverBox();
  void CountSecondDerivatives() { ++evaluations_; }
  std::int64_t splits() const { return splits_; }
  void CountSplit() { ++splits_; }

  std::vector<Derivatives<double>>& slacks_at_point() { return slacks_at_point_; }

  // Keeps the point and returns true if it surely satisfies the inequalities and attains more than
  // the best point.
  bool Offer(std::span<const double> point);
  bool SurelyFeasible(std::span<const double> point);
  bool has_best() const { return best_value_ > -std::numeric_limits<double>::infinity(); }
  const std::vector<double>& best_point() const { return best_point_; }
  // Returns a lower bound of the expression's value at the best point, or -infinity if there is no
  // point.
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

// Returns the midpoint of each variable's interval, where searches for good points begin.
std::vector<double> CentreOf(std::span<const Interval> box);

}  // namespace assay::algebra
