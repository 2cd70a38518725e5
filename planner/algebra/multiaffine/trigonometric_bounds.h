#pragma once

#include <span>
#include <vector>

#include "planner/algebra/bounding_methods/quadratic_bound.h"
#include "planner/algebra/multiaffine/multiaffine_form.h"
#include "planner/algebra/multiaffine/sector.h"
#include "planner/algebra/multiaffine/trigonometric_polynomial.h"

namespace assay::algebra {

// Bounds forms in which only angles are free, as trigonometric polynomials over parts of a box.
// Several parts may share one polynomial. The memory is reused from one question to the next.
class TrigonometricBounds {
 public:
  void Clear() { count_ = 0; }

  // Adds a form in which the variables `angles` of `whole` alone are free, and returns its number,
  // or -1 if it has too many angles or too many sines and cosines. `error` bounds the form's
  // rounding error, and `reach` the arguments of its sines and cosines.
  int Add(const NestedForm& form, const MultiaffineForm& whole, std::span<const int> angles,
          double error, double reach);

  // A bound of the rounding errors of range, slopes and curvatures over any part of the box.
  double Error(int number) const { return polynomials_[number].error; }
  double LeftOut(int number) const { return polynomials_[number].sum.left_out(); }
  const std::vector<int>& Angles(int number) const { return polynomials_[number].angles; }

  // Evaluates a polynomial over a part of the box. `part` has the part's sectors, indexed by
  // variable. The slopes and curvatures of the evaluation are indexed by place in Angles.
  const TrigonometricEvaluation& Evaluate(int number, std::span<const Sector> part);

  // Returns an upper bound of how far the polynomial that was evaluated last rises in the part
  // above its value at the middle of the part. `slopes` are its slopes there, for the angles that
  // have a width.
  double GreatestRise(int number, std::span<const Sector> part, std::span<const double> slopes);
  // Returns true if GreatestRise found the polynomial to be concave in this part of the box.
  bool IsConcave() const { return quadratic_bound_.IsConcave(); }

 private:
  struct Polynomial {
    TrigonometricPolynomial sum;
    std::vector<int> angles;
    double error = 0;
  };

  std::vector<Polynomial> polynomials_;
  int count_ = 0;  // number of elements that this question uses
  TrigonometricEvaluation evaluation_;
  QuadraticBound quadratic_bound_;
  numeric::SymmetricMatrix curvature_;
  std::vector<numeric::NearestInterval> box_;
  std::vector<double> widths_;
  std::vector<int> cosines_, places_;
};

}  // namespace assay::algebra
