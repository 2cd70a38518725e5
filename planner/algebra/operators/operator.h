#pragma once

namespace assay::algebra {

struct OperatorRule;

// Tells what an expression is: a constant, a variable, or an operation on other expressions. An
// operator refers to its rules (operator_rule.h) and is cheap to copy. Two operators are equal if
// they refer to the same rules.
class Operator {
 public:
  static const Operator kConstant;
  static const Operator kVariable;
  static const Operator kSum;       // two or more operands
  static const Operator kProduct;   // two or more operands
  static const Operator kPower;     // operand ^ exponent; the exponent is not 0 or 1
  static const Operator kQuotient;  // operand 0 / operand 1
  static const Operator kSin;
  static const Operator kCos;
  static const Operator kSqrt;
  static const Operator kAbs;
  static const Operator kMin;  // two operands
  static const Operator kMax;  // two operands

  // The rules must outlive every expression with this operator.
  constexpr explicit Operator(const OperatorRule& rule) : rule_(&rule) {}

  const OperatorRule& rule() const { return *rule_; }
  bool operator==(const Operator&) const = default;

 private:
  const OperatorRule* rule_;
};

// The rules of each operator are defined in the operator's own file.
extern const OperatorRule kConstantRule, kVariableRule, kSumRule, kProductRule, kPowerRule,
    kQuotientRule, kSinRule, kCosRule, kSqrtRule, kAbsRule, kMinRule, kMaxRule;

inline constexpr Operator Operator::kConstant{kConstantRule};
inline constexpr Operator Operator::kVariable{kVariableRule};
inline constexpr Operator Operator::kSum{kSumRule};
inline constexpr Operator Operator::kProduct{kProductRule};
inline constexpr Operator Operator::kPower{kPowerRule};
inline constexpr Operator Operator::kQuotient{kQuotientRule};
inline constexpr Operator Operator::kSin{kSinRule};
inline constexpr Operator Operator::kCos{kCosRule};
inline constexpr Operator Operator::kSqrt{kSqrtRule};
inline constexpr Operator Operator::kAbs{kAbsRule};
inline constexpr Operator Operator::kMin{kMinRule};
inline constexpr Operator Operator::kMax{kMaxRule};

}  // namespace assay::algebra
