#pragma once

#include <compare>
#include <memory>
#include <optional>

namespace assay::numeric {

// An exact rational number. It is an immutable value and cheap to copy. Every finite double is a
// rational number.
class Rational {
 public:
  Rational() = default;    // 0
  Rational(double value);  // NOLINT: doubles are rationals; the value must be finite (checked)

  int Sign() const;  // returns -1, 0 or 1
  bool IsZero() const { return number_ == nullptr; }

  // RoundedUp returns the least double that is not below the number, and RoundedDown the greatest
  // that is not above it. Both are infinite beyond the range of doubles.
  double RoundedUp() const;
  double RoundedDown() const;
  double Nearest() const;  // the nearer of RoundedDown() and RoundedUp(); always finite
  std::optional<double> Exactly() const;  // a value only if the number is a double

  // Numerator() / Denominator() is the number in lowest terms. The denominator is positive.
  Rational Numerator() const;
  Rational Denominator() const;

  friend Rational operator-(const Rational& a);
  friend Rational operator+(const Rational& a, const Rational& b);
  friend Rational operator-(const Rational& a, const Rational& b);
  friend Rational operator*(const Rational& a, const Rational& b);
  friend Rational operator/(const Rational& a, const Rational& b);  // b must not be 0 (checked)
  friend bool operator==(const Rational& a, const Rational& b);
  friend std::strong_ordering operator<=>(const Rational& a, const Rational& b);

 private:
  struct Number;
  explicit Rational(Number number);
  const Number& number() const;

  std::shared_ptr<const Number> number_;  // null stands for 0
};

Rational Abs(const Rational& a);

}  // namespace assay::numeric
