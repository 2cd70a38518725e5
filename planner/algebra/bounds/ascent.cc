#include "planner/algebra/bounds/ascent.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/numeric/interval_arithmetic.h"
#include "planner/numeric/positive_definite.h"

namespace assay::algebra {
namespace {

constexpr int kCornerSteps = 4;
constexpr int kNewtonSteps = 40;
constexpr int kMostVariablesForNewton = 16;  // with more variables: steepest ascent

// One ascent. Coordinates are scaled by the widths of the box, so that one damping suits all of
// them.
class Ascent {
 public:
  Ascent(std::vector<double> start, Probe& probe, std::span<const Interval> box)
      : probe_(probe), box_(box), point_(std::move(start)), value_(probe.Value(point_)) {}

  std::vector<double> Climb() {
    for (int step = 0; step < kNewtonSteps && std::isfinite(value_); ++step) {
      gradient_ = probe_.Gradient();
      FindFree();
      if (free_.empty() || !Improve()) break;
    }
    return std::move(point_);
  }

 private:
  double Scale(int variable) const {
    return std::min(Width(box_[variable]), 1 + std::abs(point_[variable]));
  }

  // Finds the variables that the gradient does not hold at an end of their intervals.
  void FindFree() {
    free_.clear();
    for (int i = 0; i < static_cast<int>(point_.size()); ++i) {
      const Interval& range = box_[i];
      const bool can_move = (gradient_[i] > 0 && point_[i] < range.high) ||
                            (gradient_[i] < 0 && point_[i] > range.low);
      if (can_move) free_.push_back(i);
    }
  }

  // Returns the negated second derivatives with respect to the free variables, scaled.
  numeric::SymmetricMatrix Curvature() {
    const int n = static_cast<int>(free_.size());
    numeric::SymmetricMatrix curvature;
    curvature.Reset(n);
    if (n > kMostVariablesForNewton) return curvature;
    for (int i = 0; i < n; ++i) {
      probe_.CountSecondDerivatives();
      const std::vector<double>& row = probe_.at_point().SecondDerivatives(free_[i]);
      for (int j = 0; j < n; ++j) {
        curvature(i, j) = -row[free_[j]] * Scale(free_[i]) * Scale(free_[j]);
      }
    }
    return curvature;
  }

  bool Improve() {
    const numeric::SymmetricMatrix curvature = Curvature();
    std::vector<double> slope;
    double steepest = 0;
    for (int variable : free_) {
      slope.push_back(gradient_[variable] * Scale(variable));
      steepest = std::max(steepest, std::abs(slope.back()));
    }
    if (!(steepest > kNegligible * (1 + std::abs(value_)))) return false;
    for (double damping = 0; damping <= 1e6; damping = std::max(damping * 8, 1e-3)) {
      numeric::SymmetricMatrix damped = curvature;
      for (int i = 0; i < damped.size(); ++i) damped(i, i) += damping * steepest;
      if (!FactorPositiveDefinite(damped)) continue;
      std::vector<double> step = slope;
      SolveFactored(damped, step);
      if (IsLast(step, slope)) return Finish(step);
      if (Try(step)) return true;
    }
    return false;
  }

  // Returns true if the step gains so little that the rounded value does not show the gain. The
  // ascent then ends with this step. The step is still worth taking, because it brings the slopes
  // nearer to zero.
  bool IsLast(const std::vector<double>& step, const std::vector<double>& slope) const {
    double gain = 0;
    for (std::size_t i = 0; i < step.size(); ++i) gain += step[i] * slope[i] / 2;
    return gain < kInvisible * (1 + std::abs(value_));
  }

  bool Finish(const std::vector<double>& step) {
    point_ = After(step);
    return false;
  }

  std::vector<double> After(const std::vector<double>& step) const {
    std::vector<double> next = point_;
    for (std::size_t i = 0; i < free_.size(); ++i) {
      const int variable = free_[i];
      next[variable] = std::clamp(point_[variable] + step[i] * Scale(variable), box_[variable].low,
                                  box_[variable].high);
    }
    return next;
  }

  bool Try(const std::vector<double>& step) {
    std::vector<double> next = After(step);
    const double value = probe_.Value(next);
    if (!(value > value_ + kNegligible * std::abs(value_))) return false;
    point_ = std::move(next);
    value_ = value;
    return true;
  }

  Probe& probe_;
  std::span<const Interval> box_;
  std::vector<double> point_;
  double value_;
  std::vector<double> gradient_;
  std::vector<int> free_;
};

}  // namespace

std::vector<double> AscendToCorner(Probe& probe, std::span<const Interval> box) {
  std::vector<double> best = CentreOf(box);
  double best_value = probe.Value(best);
  for (int step = 0; step < kCornerSteps; ++step) {
    const std::vector<double>& gradient = probe.Gradient();
    std::vector<double> next = best;
    for (std::size_t i = 0; i < box.size(); ++i) {
      const double end = gradient[i] > 0 ? box[i].high : box[i].low;
      if (gradient[i] != 0 && std::isfinite(end)) next[i] = end;
    }
    if (next == best) break;
    const double value = probe.Value(next);
    if (!(value > best_value) && std::isfinite(best_value)) break;
    best = std::move(next);
    best_value = value;
  }
  return best;
}

std::vector<double> AscendFrom(std::vector<double> start, Probe& probe,
                               std::span<const Interval> box) {
  return Ascent(std::move(start), probe, box).Climb();
}

}  // namespace assay::algebra
