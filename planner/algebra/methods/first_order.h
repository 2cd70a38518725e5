#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "planner/algebra/bounds/bounds.h"
#include "planner/algebra/expression/expression.h"
#include "planner/algebra/methods/affine_form.h"
#include "planner/algebra/methods/glance.h"

namespace assay::algebra {

// Expressions over a box to first order: every variable is centre + radius * t with t in [-1, 1],
// and e is centre + sum of slope * t, but for a rest that stays within bounds (affine arithmetic,
// Comba and Stolfi 1993, with the variables alone for symbols). The same sum tells from both sides:
// the greatest value of e is that of the linear part, give or take the rest.
//
// Worked out once for each stored expression, so that many that share most of what they are made of
// cost little more than one. Knows sums, products, positive powers, sines and cosines; of anything
// else it tells nothing. Rounding is counted in the rest.
class FirstOrderForms {
 public:
  // As GlanceAbove and GlanceBelow: infinitely far apart where nothing is known. Where the limit is
  // in between, e is evaluated at the corner that the slopes point to. All expressions are of one
  // pool; the variables' intervals by VariableId, the same whenever it is asked.
  Glance Above(const Expression& e, std::span<const Interval> box, double limit);
  Glance Below(const Expression& e, std::span<const Interval> box, double limit);

  // With the corner that the slopes point to, from which the gap is measured.
  Bound BoundAbove(const Expression& e, std::span<const Interval> box);
  Bound BoundBelow(const Expression& e, std::span<const Interval> box);

  // As AffineFormOf, whose rest is tighter and takes longer; none where nothing is known.
  std::optional<AffineForm> Affine(const Expression& e, std::span<const Interval> box,
                                   double negligible);

 private:
  struct Slope {
    int variable = 0;
    double value = 0;
  };
  struct Form {
    double centre = 0;
    double rest = 0;                 // infinite: nothing is known
    double reach = 0;                // of the linear part: the sum of the slopes' sizes
    std::vector<Slope> slopes = {};  // by increasing variable
  };
  // Sums of slopes, by variable.
  class Slopes {
   public:
    void Add(int variable, double slope);
    std::vector<Slope> Take();  // by increasing variable; leaves none

   private:
    static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> total_;
    std::vector<int> variables_;  // that have a slope
  };
  struct Known {
    bool is_known = false;
    Form form = {};
  };

  const Form& FormOf(const Expression& e, std::span<const Interval> box);
  Form Made(const Expression& e, std::span<const Interval> box);
  const Form& Of(const Expression& operand) const { return known_[operand.index()].form; }
  std::vector<double> Corner(const Expression& e, double sign, std::span<const Interval> box) const;

  static Form OfNumber(double value);
  static Form OfVariable(int variable, const Interval& range);
  static Form Product(const Form& a, const Form& b);
  static Form Wave(const Form& a, double value, double slope);
  Form OfSum(std::span<const Expression> terms);
  Form OfProduct(std::span<const Expression> factors) const;

  std::vector<Known> known_;      // by Expression::index
  std::vector<Expression> open_;  // scratch: yet to be worked out
  Slopes total_;                  // scratch
};

}  // namespace assay::algebra
