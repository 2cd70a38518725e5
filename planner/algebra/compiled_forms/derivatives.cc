#include "planner/algebra/compiled_forms/derivatives.h"

#include <algorithm>
#include <array>
#include <type_traits>

#include "planner/algebra/operators/point_or_box.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {
namespace {

template <class Number>
Number Constant(const Interval& value) {
  if constexpr (std::is_same_v<Number, double>) {
    return Midpoint(value);
  } else {
    return value;
  }
}

Interval AsInterval(double x) { return {x, x}; }
const Interval& AsInterval(const Interval& x) { return x; }

template <class Number>
Number ValueBy(const OperatorRule& rule, std::span<const Number> operands, int exponent) {
  if constexpr (std::is_same_v<Number, double>) {
    return rule.value(operands, exponent);
  } else {
    return rule.range(operands, exponent);
  }
}

// The ends are copied one by one. A copy of both at once would wait until they are in memory.
void Put(const Interval& value, Interval& place) {
  place.low = value.low;
  place.high = value.high;
}
void Put(double value, double& place) { place = value; }

bool HasTwoOperands(const CompiledForm::Step& step) { return step.op.rule().operand_count == 2; }

}  // namespace

template <class Number>
Derivatives<Number>::Derivatives(const CompiledForm& form)
    : form_(form), value_(form.steps.size()), gradient_(form.affine.size()) {}

template <class Number>
Number Derivatives<Number>::Value(std::span<const Number> place) {
  defined_everywhere_ = defined_somewhere_ = true;
  for (std::size_t i = 0; i < form_.steps.size(); ++i) {
    Put(ValueOf(form_.steps[i], place), value_[i]);
  }
  return value_.back();
}

// Sums and products are computed here and not by their rules. They are most of the steps, and take
// less time than a call.
template <class Number>
Number Derivatives<Number>::ValueOf(const Step& step, std::span<const Number> place) {
  if (step.op == Operator::kProduct) return value_[step.a] * value_[step.b];
  if (step.op == Operator::kSum) return value_[step.a] + value_[step.b];
  if (step.op == Operator::kConstant) return Constant<Number>(form_.constants[step.a]);
  if (step.op == Operator::kVariable) return place[step.a];
  if (step.may_be_undefined) NoteDefinedness(step);
  const OperatorRule& rule = step.op.rule();
  if (rule.operand_count == 1) return ValueBy<Number>(rule, {&value_[step.a], 1}, step.exponent);
  return ValueBy<Number>(rule, std::array{value_[step.a], value_[step.b]}, step.exponent);
}

template <class Number>
void Derivatives<Number>::NoteDefinedness(const Step& step) {
  const OperatorRule& rule = step.op.rule();
  const std::array<Interval, 2> operands = {
      AsInterval(value_[step.a]),
      rule.operand_count == 1 ? Interval() : AsInterval(value_[step.b])};
  const Definedness definedness =
      rule.definedness(std::span(operands).first(rule.operand_count), step.exponent);
  if (definedness != Definedness::kEverywhere) defined_everywhere_ = false;
  if (definedness == Definedness::kNowhere) defined_somewhere_ = false;
}

template <class Number>
FunctionPlace<Number> Derivatives<Number>::PlaceOf(const Step& step, int index) const {
  return {.a = value_[step.a],
          .b = value_[step.b < 0 ? step.a : step.b],
          .value = value_[index],
          .exponent = step.exponent};
}

template <class Number>
Number Derivatives<Number>::Slope(int index, int operand) const {
  const Step& step = form_.steps[index];
  const auto slope = step.op.rule().slope.template For<Number>();
  return slope(PlaceOf(step, index), operand);
}

template <class Number>
Number Derivatives<Number>::Curvature(int index, int i, int j) const {
  const Step& step = form_.steps[index];
  const auto curvature = step.op.rule().curvature.template For<Number>();
  return curvature(PlaceOf(step, index), i, j);
}

template <class Number>
const std::vector<Number>& Derivatives<Number>::Gradient() {
  adjoint_.assign(form_.steps.size(), Exactly<Number>(0));
  std::fill(gradient_.begin(), gradient_.end(), Exactly<Number>(0));
  adjoint_.back() = Exactly<Number>(1);
  for (int i = static_cast<int>(form_.steps.size()) - 1; i >= 0; --i) {
    if (!IsZero(adjoint_[i])) PropagateAdjoint(i);
  }
  return gradient_;
}

template <class Number>
void Derivatives<Number>::PropagateAdjoint(int index) {
  const Step& step = form_.steps[index];
  const Number adjoint = adjoint_[index];
  const auto add = [&](int operand, const Number& change) {
    adjoint_[operand] = adjoint_[operand] + change;
  };
  const auto is_constant = [&](int operand) {
    return form_.steps[operand].op == Operator::kConstant;
  };
  if (step.op == Operator::kVariable) {
    gradient_[step.a] = adjoint;
  } else if (step.op == Operator::kSum) {
    add(step.a, adjoint);
    add(step.b, adjoint);
  } else if (step.op == Operator::kProduct) {
    if (!is_constant(step.a)) add(step.a, adjoint * value_[step.b]);
    if (!is_constant(step.b)) add(step.b, adjoint * value_[step.a]);
  } else if (step.op != Operator::kConstant) {
    add(step.a, adjoint * Slope(index, 0));
    if (HasTwoOperands(step)) add(step.b, adjoint * Slope(index, 1));
  }
}

template <class Number>
void Derivatives<Number>::PropagateTangent(int variable) {
  const Number zero = Exactly<Number>(0);
  tangent_.assign(form_.steps.size(), zero);
  for (std::size_t i = 0; i < form_.steps.size(); ++i) {
    const Step& step = form_.steps[i];
    if (step.op == Operator::kVariable) {
      tangent_[i] = Exactly<Number>(step.a == variable ? 1 : 0);
    } else if (step.op == Operator::kConstant ||
               (IsZero(tangent_[step.a]) && (step.b < 0 || IsZero(tangent_[step.b])))) {
      continue;
    } else if (step.op == Operator::kSum) {
      tangent_[i] = tangent_[step.a] + tangent_[step.b];
    } else if (step.op == Operator::kProduct) {
      tangent_[i] = tangent_[step.a] * value_[step.b] + value_[step.a] * tangent_[step.b];
    } else {
      tangent_[i] = tangent_[step.a] * Slope(static_cast<int>(i), 0);
      if (HasTwoOperands(step)) {
        tangent_[i] = tangent_[i] + tangent_[step.b] * Slope(static_cast<int>(i), 1);
      }
    }
  }
}

template <class Number>
void Derivatives<Number>::PropagateAdjointTangent(int index) {
  const Step& step = form_.steps[index];
  const Number change = adjoint_tangent_[index];
  const auto add = [&](int operand, const Number& more) {
    adjoint_tangent_[operand] = adjoint_tangent_[operand] + more;
  };
  if (step.op == Operator::kVariable) {
    row_[step.a] = change;
  } else if (step.op == Operator::kSum) {
    add(step.a, change);
    add(step.b, change);
  } else if (step.op == Operator::kProduct) {
    add(step.a, change * value_[step.b] + adjoint_[index] * tangent_[step.b]);
    add(step.b, change * value_[step.a] + adjoint_[index] * tangent_[step.a]);
  } else if (step.op != Operator::kConstant) {
    add(step.a, ChangeOfAdjoint(index, 0));
    if (HasTwoOperands(step)) add(step.b, ChangeOfAdjoint(index, 1));
  }
}

// Returns the derivative of what a step of a function adds to the adjoint of one of its operands.
template <class Number>
Number Derivatives<Number>::ChangeOfAdjoint(int index, int operand) const {
  const Step& step = form_.steps[index];
  Number change = adjoint_tangent_[index] * Slope(index, operand);
  const auto add = [&](int other, const Number& tangent) {
    if (IsZero(tangent)) return;
    change = change + adjoint_[index] * Curvature(index, operand, other) * tangent;
  };
  add(0, tangent_[step.a]);
  if (HasTwoOperands(step)) add(1, tangent_[step.b]);
  return change;
}

template <class Number>
const std::vector<Number>& Derivatives<Number>::SecondDerivatives(int variable) {
  PropagateTangent(variable);
  adjoint_tangent_.assign(form_.steps.size(), Exactly<Number>(0));
  row_.assign(form_.affine.size(), Exactly<Number>(0));
  for (int i = static_cast<int>(form_.steps.size()) - 1; i >= 0; --i) {
    if (!IsZero(adjoint_[i]) || !IsZero(adjoint_tangent_[i])) PropagateAdjointTangent(i);
  }
  return row_;
}

template class Derivatives<double>;
template class Derivatives<Interval>;

}  // namespace assay::algebra
