#pragma once

#include <span>
#include <vector>

#include "planner/algebra/numeric/positive_definite.h"

namespace assay::algebra {

// Bounds of quadratic functions over a box about 0 whose matrix of second derivatives is known to
// be no larger than another one. What keeps that one from being concave is made up for by a
// multiple of the squared distances, as in the alpha BB method (Adjiman and Floudas 1996).
class QuadraticBound {
 public:
  // `curvature`: the matrix that the others do not exceed by more than `error` in any entry.
  void SetCurvature(const SymmetricMatrix& curvature, double error, std::span<const double> widths);

  // Whether all of the matrices are negative definite.
  bool IsConcave() const { return shift_ == 0; }

  // No less than slopes . d + d . C d / 2 for any such C, where -widths/2 <= d <= widths/2.
  double Most(std::span<const double> slopes);

 private:
  bool IsEnough(double shift);
  void FindShift();
  double Slope(int i) const;

  // In units of the widths; the matrix is minus the curvature.
  SymmetricMatrix matrix_, shifted_, deviation_;
  double shift_ = 0;  // that makes it positive definite
  std::vector<double> widths_, slopes_, place_;
};

}  // namespace assay::algebra
