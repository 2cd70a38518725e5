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

// Expressions over a box to first order, by affine arithmetic (Comba and Stolfi 1993) in which the
// variables are the only symbols. Every variable is centre + radius * t with t in [-1, 1]. An
// expression is its centre plus the sum of slope * t plus a rest that is bounded. One form bounds
// the extremum from both sides: the greatest value of e is that of the linear part, plus or minus
// the rest.
//
// The form of each stored expression is computed once, so that many expressions with common parts
// cost little more than one. The forms cover sums, products, positive powers, sines and cosines.
// Any other operation gives an unknown form. Rounding errors are included in the rest.
class FirstOrderForms {
 public:
  // Above and Below return a bound of e like GlanceAbove and GlanceBelow. For an unknown form,
  // `bound` and `attained` are infinitely far apart. If the limit is between them, e is evaluated
  // at the corner to which the slopes point. All expressions must be of one pool. The box is
  // indexed by VariableId and must be the same in every call.
  Glance Above(const Expression& e, std::span<const Interval> box, double limit);
  Glance Below(const Expression& e, std::span<const Interval> box, double limit);

  // BoundAbove and BoundBelow return a bound and the corner to which the slopes point. The gap is
  // measured from the value at that corner.
  Bound BoundAbove(const Expression& e, std::span<const Interval> box);
  Bound BoundBelow(const Expression& e, std::span<const Interval> box);

  // Returns an affine form more quickly than AffineFormOf, whose rest is tighter. Returns nothing
  // if the form is unknown.
  std::optional<AffineForm> Affine(const Expression& e, std::span<const Interval> box,
                                   double negligible);

 private:
  struct Slope {
    int variable = 0;
    double value = 0;
  };
  struct Form {
    double centre = 0;
    double rest = 0;                 // infinite if the form is unknown
    double reach = 0;                // the sum of the absolute slopes
    std::vector<Slope> slopes = {};  // sorted by variable
  };
  // Adds up slopes for each variable.
  class Slopes {
   public:
    void Add(int variable, double slope);
    std::vector<Slope> Take();  // sorted by variable; the object is empty afterwards

   private:
    static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> total_;
    std::vector<int> variables_;  // the variables that have a slope
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

  std::vector<Known> known_;      // indexed by Expression::index
  std::vector<Expression> open_;  // scratch: expressions whose form is still to be computed
  Slopes total_;                  // scratch
};

}  // namespace assay::algebra
