#pragma once

#include <limits>
#include <span>
#include <vector>

#include "planner/base/interval.h"

namespace assay::algebra {

// An expression over a box to first order: centre, plus the sum of slope * t over the variables,
// plus a rest. Every variable is its centre + radius * t with t in [-1, 1]. The rest lies in
// [-rest, rest] and includes all rounding errors.
struct FirstOrderForm {
  struct Slope {
    int variable = 0;
    double value = 0;
  };

  double centre = 0;
  double rest = 0;                 // infinite if the form is unknown
  double reach = 0;                // the sum of the absolute slopes
  std::vector<Slope> slopes = {};  // sorted by variable

  static FirstOrderForm Unknown() { return {.rest = std::numeric_limits<double>::infinity()}; }
  static FirstOrderForm OfVariable(int variable, const Interval& range);
};

// Affine arithmetic on first-order forms (Comba and Stolfi 1993).
class FirstOrderArithmetic {
 public:
  FirstOrderForm Sum(std::span<const FirstOrderForm* const> terms);
  static FirstOrderForm Product(const FirstOrderForm& a, const FirstOrderForm& b);
  // Returns the sine or cosine of a form, or any other function with a second derivative that is
  // minus the function itself and with values in [-1, 1]. `value` and `slope` are the function's
  // value and derivative at the centre.
  static FirstOrderForm Sinusoid(const FirstOrderForm& a, double value, double slope);

 private:
  // Adds up slopes for each variable.
  class Slopes {
   public:
    void Add(const FirstOrderForm::Slope& slope);
    std::vector<FirstOrderForm::Slope> Take();  // sorted; the object is empty afterwards

   private:
    static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> total_;
    std::vector<int> variables_;  // the variables that have a slope
  };

  Slopes total_;  // scratch
};

// A bound of the rounding error of a few operations on doubles, relative to their operands.
inline constexpr double kFewRoundings = 1e-15;

// Returns an upper bound of the exact sum of non-negative numbers. `sum` is their rounded sum.
inline double AtLeast(double sum) { return sum * (1 + 1e-12); }

}  // namespace assay::algebra
