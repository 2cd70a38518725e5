#include "planner/algebra/forms/derivatives.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/algebra/numeric/interval_arithmetic.h"
#include "planner/base/check.h"

namespace assay::algebra {
namespace {

// The operations for both kinds of numbers: doubles and intervals.
double RaisedTo(double a, int n) {
  if (n < 0) return 1 / RaisedTo(a, -n);
  double power = 1;
  for (; n > 0; n /= 2, a *= a) {
    if (n % 2 == 1) power *= a;
  }
  return power;
}
Interval RaisedTo(const Interval& a, int n) { return Power(a, n); }
double Sine(double a) { return std::sin(a); }
Interval Sine(const Interval& a) { return Sin(a); }
double Cosine(double a) { return std::cos(a); }
Interval Cosine(const Interval& a) { return Cos(a); }
double SquareRoot(double a) { return std::sqrt(a); }
Interval SquareRoot(const Interval& a) { return Sqrt(a); }
double AbsoluteValue(double a) { return std::abs(a); }
Interval AbsoluteValue(const Interval& a) { return Abs(a); }
double Lesser(double a, double b) { return std::min(a, b); }
Interval Lesser(const Interval& a, const Interval& b) { return Min(a, b); }
double Greater(double a, double b) { return std::max(a, b); }
Interval Greater(const Interval& a, const Interval& b) { return Max(a, b); }

template <class Number>
Number Exactly(double x) {
  if constexpr (std::is_same_v<Number, double>) {
    return x;
  } else {
    return {x, x};
  }
}

double Low(double a) { return a; }
double Low(const Interval& a) { return a.low; }
double High(double a) { return a; }
double High(const Interval& a) { return a.high; }
bool IsZero(double a) { return a == 0; }
bool IsZero(const Interval& a) { return a.low == 0 && a.high == 0; }

// Returns a number that stands for an unknown or undefined value.
template <class Number>
Number Unknown() {
  if constexpr (std::is_same_v<Number, double>) {
    return std::numeric_limits<double>::quiet_NaN();
  } else {
    return kWholeLine;
  }
}

// Returns the slope at a place where it may jump from `low` to `high`. It occurs in |a|, min and
// max. The interval covers both sides.
template <class Number>
Number Between(double low, double high) {
  if constexpr (std::is_same_v<Number, double>) {
    return high;
  } else {
    return {low, high};
  }
}

template <class Number>
Number Constant(const Interval& value) {
  if constexpr (std::is_same_v<Number, double>) {
    return Midpoint(value);
  } else {
    return value;
  }
}

// Returns the derivative of min or max with respect to the first operand. The derivative with
// respect to the second operand is one minus this.
template <class Number>
Number SlopeByFirst(Operator op, const Number& a, const Number& b) {
  const bool first_is_less = High(a) < Low(b);
  const bool second_is_less = High(b) < Low(a);
  if (!first_is_less && !second_is_less) return Between<Number>(0, 1);
  return Exactly<Number>((op == Operator::kMin) == first_is_less ? 1 : 0);
}

template <class Number>
bool MayJump(const Number& a, const Number& b) {
  return High(a) >= Low(b) && High(b) >= Low(a);
}

bool HasOneOperand(Operator op) {
  switch (op) {
    case Operator::kPower:
    case Operator::kSin:
    case Operator::kCos:
    case Operator::kSqrt:
    case Operator::kAbs:
      return true;
    case Operator::kConstant:
    case Operator::kVariable:
    case Operator::kSum:
    case Operator::kProduct:
    case Operator::kQuotient:
    case Operator::kMin:
    case Operator::kMax:
      return false;
  }
  ASSAY_CHECK(false, "no such operator");
}

}  // namespace

template <class Number>
Derivatives<Number>::Derivatives(const CompiledForm& form)
    : form_(form), value_(form.steps.size()), gradient_(form.affine.size()) {}

template <class Number>
Number Derivatives<Number>::Value(std::span<const Number> place) {
  defined_everywhere_ = defined_somewhere_ = true;
  for (std::size_t i = 0; i < form_.steps.size(); ++i) value_[i] = ValueOf(form_.steps[i], place);
  return value_.back();
}

template <class Number>
Number Derivatives<Number>::ValueOf(const Step& step, std::span<const Number> place) {
  switch (step.op) {
    case Operator::kConstant:
      return Constant<Number>(form_.constants[step.a]);
    case Operator::kVariable:
      return place[step.a];
    case Operator::kSum:
      return value_[step.a] + value_[step.b];
    case Operator::kProduct:
      return value_[step.a] * value_[step.b];
    case Operator::kPower:
      if (step.exponent < 0 && Low(value_[step.a]) <= 0 && High(value_[step.a]) >= 0) {
        defined_everywhere_ = false;
        if (IsZero(value_[step.a])) defined_somewhere_ = false;
        return Unknown<Number>();
      }
      return RaisedTo(value_[step.a], step.exponent);
    case Operator::kSin:
      return Sine(value_[step.a]);
    case Operator::kCos:
      return Cosine(value_[step.a]);
    case Operator::kSqrt:
      if (Low(value_[step.a]) < 0) defined_everywhere_ = false;
      if (High(value_[step.a]) < 0) {
        defined_somewhere_ = false;
        return Unknown<Number>();
      }
      return SquareRoot(value_[step.a]);
    case Operator::kAbs:
      return AbsoluteValue(value_[step.a]);
    case Operator::kMin:
      return Lesser(value_[step.a], value_[step.b]);
    case Operator::kMax:
      return Greater(value_[step.a], value_[step.b]);
    case Operator::kQuotient:
      break;  // compiled as a product with a reciprocal
  }
  ASSAY_CHECK(false, "no such step");
}

template <class Number>
Number Derivatives<Number>::Slope(const Step& step, int index) const {
  const Number& a = value_[step.a];
  switch (step.op) {
    case Operator::kPower:
      return Exactly<Number>(step.exponent) * RaisedTo(a, step.exponent - 1);
    case Operator::kSin:
      return value_[step.b];
    case Operator::kCos:
      return -value_[step.b];
    case Operator::kSqrt:
      if (Low(a) <= 0) return Unknown<Number>();
      return Exactly<Number>(0.5) * RaisedTo(value_[index], -1);
    case Operator::kAbs:
      if (Low(a) >= 0) return Exactly<Number>(1);
      if (High(a) <= 0) return Exactly<Number>(-1);
      return Between<Number>(-1, 1);
    case Operator::kConstant:
    case Operator::kVariable:
    case Operator::kSum:
    case Operator::kProduct:
    case Operator::kQuotient:
    case Operator::kMin:
    case Operator::kMax:
      break;
  }
  ASSAY_CHECK(false, "not a step with one operand");
}

template <class Number>
Number Derivatives<Number>::Curvature(const Step& step, int index) const {
  const Number& a = value_[step.a];
  switch (step.op) {
    case Operator::kPower:
      return Exactly<Number>(static_cast<double>(step.exponent) * (step.exponent - 1.0)) *
             RaisedTo(a, step.exponent - 2);
    case Operator::kSin:
    case Operator::kCos:
      return -value_[index];
    case Operator::kSqrt:
      if (Low(a) <= 0) return Unknown<Number>();
      return Exactly<Number>(-0.25) * RaisedTo(value_[index], -3);
    case Operator::kAbs:
      return Low(a) > 0 || High(a) < 0 ? Exactly<Number>(0) : Unknown<Number>();
    case Operator::kConstant:
    case Operator::kVariable:
    case Operator::kSum:
    case Operator::kProduct:
    case Operator::kQuotient:
    case Operator::kMin:
    case Operator::kMax:
      break;
  }
  ASSAY_CHECK(false, "not a step with one operand");
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
  } else if (step.op == Operator::kMin || step.op == Operator::kMax) {
    const Number slope = SlopeByFirst(step.op, value_[step.a], value_[step.b]);
    add(step.a, adjoint * slope);
    add(step.b, adjoint * (Exactly<Number>(1) - slope));
  } else if (HasOneOperand(step.op)) {
    add(step.a, adjoint * Slope(step, index));
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
    } else if (step.op == Operator::kMin || step.op == Operator::kMax) {
      const Number slope = SlopeByFirst(step.op, value_[step.a], value_[step.b]);
      tangent_[i] = tangent_[step.a] * slope + tangent_[step.b] * (Exactly<Number>(1) - slope);
    } else {
      tangent_[i] = tangent_[step.a] * Slope(step, static_cast<int>(i));
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
  } else if (step.op == Operator::kMin || step.op == Operator::kMax) {
    const bool moves = !IsZero(tangent_[step.a]) || !IsZero(tangent_[step.b]);
    const bool jumps = moves && MayJump(value_[step.a], value_[step.b]);
    const Number slope = SlopeByFirst(step.op, value_[step.a], value_[step.b]);
    add(step.a, jumps ? Unknown<Number>() : change * slope);
    add(step.b, jumps ? Unknown<Number>() : change * (Exactly<Number>(1) - slope));
  } else if (HasOneOperand(step.op)) {
    Number more = change * Slope(step, index);
    if (!IsZero(tangent_[step.a])) {
      more = more + adjoint_[index] * Curvature(step, index) * tangent_[step.a];
    }
    add(step.a, more);
  }
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
