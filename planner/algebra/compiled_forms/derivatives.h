#pragma once

#include <span>
#include <vector>

#include "planner/algebra/compiled_forms/compiled_form.h"
#include "planner/algebra/operators/operator_rule.h"

namespace assay::algebra {

// Computes the value of a compiled form and its derivatives. With Number = double they are computed
// at a point and not rounded outward. With Number = Interval they are computed over a box: the
// results are rounded outward and contain the value and the derivatives at every point of the box.
// The gradient takes one backward pass over the steps, for any number of variables. Each row of the
// matrix of second derivatives takes one more forward and one more backward pass.
//
// At a kink (of abs, min, max) the gradient over a box contains all slopes on both sides, and the
// second derivative is the whole line. Where the form may have no value (a square root of a
// negative number, a division by 0) its derivatives are the whole line, and DefinedEverywhere
// returns false.
template <class Number>
class Derivatives {
 public:
  explicit Derivatives(const CompiledForm& form);

  // Sets the point or box, indexed by variable, and returns the value there.
  Number Value(std::span<const Number> place);
  // DefinedEverywhere and DefinedSomewhere refer to the place that was last given to Value.
  bool DefinedEverywhere() const { return defined_everywhere_; }
  bool DefinedSomewhere() const { return defined_somewhere_; }
  const std::vector<Number>& Gradient();
  // Returns row `variable` of the matrix of second derivatives, indexed by variable. Call Gradient
  // first.
  const std::vector<Number>& SecondDerivatives(int variable);

 private:
  using Step = CompiledForm::Step;

  Number ValueOf(const Step& step, std::span<const Number> place);
  void NoteDefinedness(const Step& step);
  // The next four declarations are about steps that are functions. `operand`, i and j are 0 or 1.
  FunctionPlace<Number> PlaceOf(const Step& step, int index) const;
  Number Slope(int index, int operand) const;
  Number Curvature(int index, int i, int j) const;
  Number ChangeOfAdjoint(int index, int operand) const;
  void PropagateTangent(int variable);
  void PropagateAdjoint(int index);
  void PropagateAdjointTangent(int index);

  const CompiledForm& form_;
  // These vectors are indexed by step. The adjoint is the derivative of the form with respect to
  // the step's value. Tangents are derivatives, of the value and of the adjoint, with respect to
  // one variable.
  std::vector<Number> value_;
  std::vector<Number> adjoint_;
  std::vector<Number> tangent_;
  std::vector<Number> adjoint_tangent_;
  std::vector<Number> gradient_;  // indexed by variable
  std::vector<Number> row_;       // indexed by variable
  bool defined_everywhere_ = true;
  bool defined_somewhere_ = true;
};

extern template class Derivatives<double>;
extern template class Derivatives<Interval>;

}  // namespace assay::algebra
