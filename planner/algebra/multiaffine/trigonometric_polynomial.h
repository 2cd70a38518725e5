#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "planner/algebra/multiaffine/nested_form.h"
#include "planner/numeric/nearest_interval.h"
#include "planner/numeric/positive_definite.h"

namespace assay::algebra {

// A multi-affine form of angles alone as a trigonometric polynomial: constant + sum of amplitude *
// cos(phase + turns . angles), where each turn is 1, 0 or -1. This shows structure that products of
// sines and cosines hide: rotations about one axis give one term for each sum of angles. The range
// of each term over a box is exact.
class TrigonometricPolynomial {
 public:
  static constexpr int kMostAngles = 7;

  // `cosines` are the atoms of the angles' cosines, each followed by the atom of its sine. The form
  // must contain no other atoms. Returns false if there are too many angles or too many products of
  // them.
  bool Assign(const NestedForm& form, std::span<const int> cosines);

  int angle_count() const { return angle_count_; }
  int term_count() const { return static_cast<int>(terms_.size()); }
  // Returns the sum of the amplitudes of terms that are rounding alone and were left out.
  double left_out() const { return left_out_; }

 private:
  friend class TrigonometricEvaluation;
  struct Term {
    double amplitude = 0;
    double phase = 0;
    std::array<signed char, kMostAngles> turns = {};
  };

  int angle_count_ = 0;
  double constant_ = 0;
  double left_out_ = 0;
  std::vector<Term> terms_;
};

// Evaluates a trigonometric polynomial over a box: its range, slopes and curvatures. The ends of
// these intervals are rounded to nearest.
class TrigonometricEvaluation {
 public:
  void Enter(const TrigonometricPolynomial& sum, std::span<const numeric::NearestInterval> box);

  const numeric::NearestInterval& range() const { return range_; }
  const numeric::NearestInterval& Slope(int angle) const { return slopes_[angle]; }
  double LeastCurvature(int angle) const { return least_curvature_[angle]; }
  // An upper bound of the matrices of second derivatives in the box: its difference from any of
  // them is positive semidefinite. The matrix of one term is -amplitude * cosine * turns turns^T.
  const numeric::SymmetricMatrix& greatest_curvature() const { return greatest_curvature_; }

 private:
  numeric::NearestInterval range_;
  std::array<numeric::NearestInterval, TrigonometricPolynomial::kMostAngles> slopes_;
  std::array<double, TrigonometricPolynomial::kMostAngles> least_curvature_ = {};
  numeric::SymmetricMatrix greatest_curvature_;
};

}  // namespace assay::algebra
