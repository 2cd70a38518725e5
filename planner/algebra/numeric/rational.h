#pragma once

#include <compare>
#include <memory>
#include <optional>

namespace assay::algebra {

// An exact rational number: an immutable value, cheap to copy. Every finite double is one.
class Rational {
 public:
  Rational() = default;    // 0
  Rational(double value);  // NOLINT: doubles are rationals; finite (checked)

  int Sign() const;  // -1, 0, 1
  bool IsZero() const { return number_ == nullptr; }

  // The least double that is not below, the greatest that is not above; infinite beyond the range.
  double RoundedUp() const;
  double RoundedDown() const;
  double Nearest() const;                 // one of the two, the nearer; finite
  std::optional<double> Exactly() const;  // if it is a double

  // In lowest terms; the denominator is positive.
  Rational Numerator() const;
  Rational Denominator() const;

  friend Rational operator-(const Rational& a);
  friend Rational operator+(const Rational& a, const Rational& b);
  friend Rational operator-(const Rational& a, const Rational& b);
  friend Rational operator*(const Rational& a, const Rational& b);
  friend Rational operator/(const Rational& a, const Rational& b);  // b is not 0 (checked)
  friend bool operator==(const Rational& a, const Rational& b);
  friend std::strong_ordering operator<=>(const Rational& a, const Rational& b);

 private:
  struct Number;
  explicit Rational(Number number);
  const Number& number() const;

  std::shared_ptr<const Number> number_;  // null: 0
};

Rational Abs(const Rational& a);

}  // namespace assay::algebra
