#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "planner/algebra/forms/nested_form.h"
#include "planner/algebra/numeric/nearest_interval.h"
#include "planner/algebra/numeric/positive_definite.h"

namespace assay::algebra {

// A multi-affine form of angles alone as a sum of waves: constant + sum of amplitude * cos(phase +
// turns . angles), in which an angle turns by 1, 0 or -1. What products of sines and cosines hide
// stands in the open: of rotations about one axis there is one wave for each sum of angles. Each
// wave's range over a box is exact.
class WaveSum {
 public:
  static constexpr int kMostAngles = 7;

  // `cosines`: the atoms of the angles' cosines; sines are the next ones. No other atoms are in the
  // form. False if there are too many angles, or too many products of them.
  bool Assign(const NestedForm& form, std::span<const int> cosines);

  int angle_count() const { return angle_count_; }
  int wave_count() const { return static_cast<int>(waves_.size()); }
  // The sum of amplitudes of waves that are rounding alone and were left out.
  double left_out() const { return left_out_; }

 private:
  friend class WaveEvaluation;
  struct Wave {
    double amplitude = 0;
    double phase = 0;
    std::array<signed char, kMostAngles> turns = {};
  };

  int angle_count_ = 0;
  double constant_ = 0;
  double left_out_ = 0;
  std::vector<Wave> waves_;
};

// A sum of waves over a box: its range, its slopes, and how it bends. Ends are rounded to nearest.
class WaveEvaluation {
 public:
  void Enter(const WaveSum& sum, std::span<const NearestInterval> box);

  const NearestInterval& range() const { return range_; }
  const NearestInterval& Slope(int angle) const { return slopes_[angle]; }
  double LeastCurvature(int angle) const { return least_curvature_[angle]; }
  // No matrix of second derivatives in the box is larger: their difference from this one is
  // positive semidefinite. For a wave's is its cosine, of either sign, times turns turns^T.
  const SymmetricMatrix& greatest_curvature() const { return greatest_curvature_; }

 private:
  NearestInterval range_;
  std::array<NearestInterval, WaveSum::kMostAngles> slopes_;
  std::array<double, WaveSum::kMostAngles> least_curvature_ = {};
  SymmetricMatrix greatest_curvature_;
};

}  // namespace assay::algebra
