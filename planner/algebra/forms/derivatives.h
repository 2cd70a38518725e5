#pragma once

#include <span>
#include <vector>

#include "planner/algebra/forms/compiled_form.h"

namespace assay::algebra {

// The value of a compiled form and its derivatives, at a point (Number = double, not rounded
// outward) or over a box (Number = Interval, outward-rounded: contains the value and the
// derivatives at every point of the box). The gradient takes one pass backwards over the steps,
// whatever the number of variables; each row of the matrix of second derivatives takes one more
// pass each way.
//
// At a kink (of abs, min, max) the gradient over a box contains all slopes on both sides, and the
// second derivative is the whole line. Where the form may have no value (a square root of less than
// 0, division by 0) its derivatives are the whole line, and DefinedEverywhere tells so.
template <class Number>
class Derivatives {
 public:
  explicit Derivatives(const CompiledForm& form);

  // Sets the place, by variable; returns the value there.
  Number Value(std::span<const Number> place);
  // Of the last place.
  bool DefinedEverywhere() const { return defined_everywhere_; }
  bool DefinedSomewhere() const { return defined_somewhere_; }
  const std::vector<Number>& Gradient();
  // Row `variable` of the second derivatives, by variable; after Gradient.
  const std::vector<Number>& SecondDerivatives(int variable);

 private:
  using Step = CompiledForm::Step;

  Number ValueOf(const Step& step, std::span<const Number> place);
  Number Slope(const Step& step, int index) const;      // of a step with one operand
  Number Curvature(const Step& step, int index) const;  // likewise
  void PropagateTangent(int variable);
  void PropagateAdjoint(int index);
  void PropagateAdjointTangent(int index);

  const CompiledForm& form_;
  std::vector<Number> value_;            // by step
  std::vector<Number> adjoint_;          // by step: derivative of the form by it
  std::vector<Number> tangent_;          // by step: its derivative by a variable
  std::vector<Number> adjoint_tangent_;  // by step: derivative of its adjoint by that variable
  std::vector<Number> gradient_;         // by variable
  std::vector<Number> row_;              // by variable
  bool defined_everywhere_ = true;
  bool defined_somewhere_ = true;
};

extern template class Derivatives<double>;
extern template class Derivatives<Interval>;

}  // namespace assay::algebra
