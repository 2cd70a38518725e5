#pragma once

#include <span>
#include <vector>

#include "planner/numeric/positive_definite.h"

namespace assay::algebra {

// Bounds quadratic functions over a box about 0, given an upper bound of their matrices of second
// derivatives. If that upper bound is not negative definite, a multiple of the squared distances
// from the box's centre makes it so, as in the alpha BB method (Adjiman and Floudas 1996).
class QuadraticBound {
 public:
  // Sets the box and the upper bound of the matrices. `widths` are the widths of the box. No matrix
  // is greater than `curvature` in the order of definiteness. Each entry of `curvature` may be off
  // by up to `error`.
  void SetCurvature(const numeric::SymmetricMatrix& curvature, double error,
                    std::span<const double> widths);

  // Returns true if all of the matrices are negative definite.
  bool IsConcave() const { return shift_ == 0; }

  // Returns an upper bound of slopes . d + d . C d / 2 for every matrix C below the bound and every
  // d with -widths/2 <= d <= widths/2.
  double Most(std::span<const double> slopes);

 private:
  bool IsEnough(double shift);
  void FindShift();
  double Slope(int i) const;

  // These matrices are in units of the box's widths. matrix_ is the negated curvature.
  numeric::SymmetricMatrix matrix_, shifted_, deviation_;
  double shift_ = 0;  // added to the diagonal, it makes matrix_ positive definite
  std::vector<double> widths_, slopes_, place_;
};

}  // namespace assay::algebra
