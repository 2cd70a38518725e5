#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planner/algebra/bounding_methods/affine_form.h"
#include "planner/algebra/bounding_methods/first_order_form.h"
#include "planner/algebra/bounding_methods/glance.h"
#include "planner/algebra/bounds/bounds.h"
#include "planner/algebra/expression/expression.h"

namespace assay::algebra {

// Expressions over a box to first order (first_order_form.h). One form bounds the extremum from
// both sides: the greatest value of e is that of the linear part, plus or minus the rest.
//
// The form of each stored expression is computed once, so that many expressions with common parts
// cost little more than one. The forms cover sums, products, positive powers, sines and cosines.
// Any other operation gives an unknown form.
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

  // Returns the form of e itself.
  const FirstOrderForm& Form(const Expression& e, std::span<const Interval> box) {
    return FormOf(e, box);
  }

 private:
  struct Known {
    bool is_known = false;
    FirstOrderForm form = {};
  };

  const FirstOrderForm& FormOf(const Expression& e, std::span<const Interval> box);
  FirstOrderForm Made(const Expression& e, std::span<const Interval> box);
  const FirstOrderForm& Of(const Expression& operand) const { return known_[operand.index()].form; }
  std::vector<double> Corner(const Expression& e, double sign, std::span<const Interval> box) const;

  std::vector<Known> known_;      // indexed by Expression::index
  std::vector<Expression> open_;  // scratch: expressions whose form is still to be computed
  std::vector<const FirstOrderForm*> operands_;  // scratch
  FirstOrderArithmetic arithmetic_;
};

}  // namespace assay::algebra
