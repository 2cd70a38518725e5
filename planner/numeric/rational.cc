#include "planner/numeric/rational.h"

#include <gmpxx.h>

#include <cmath>
#include <limits>

#include "planner/base/check.h"

namespace assay::numeric {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kGreatest = std::numeric_limits<double>::max();

// The doubles next to q on either side. Both are q itself if q is a double.
struct Neighbours {
  double below;
  double above;
};

Neighbours NeighboursOf(const mpq_class& q) {
  if (q > kGreatest) return {kGreatest, kInfinite};
  if (q < -kGreatest) return {-kInfinite, -kGreatest};
  const double truncated = q.get_d();  // truncated towards 0
  if (q == truncated) return {truncated, truncated};
  return q > 0 ? Neighbours{truncated, std::nextafter(truncated, kInfinite)}
               : Neighbours{std::nextafter(truncated, -kInfinite), truncated};
}

}  // namespace

struct Rational::Number {
  mpq_class q;
};

Rational::Rational(double value) {
  ASSAY_CHECK(std::isfinite(value), "{} is not a rational number", value);
  if (value != 0) number_ = std::make_shared<const Number>(Number{mpq_class(value)});
}

Rational::Rational(Number number) {
  if (sgn(number.q) != 0) number_ = std::make_shared<const Number>(std::move(number));
}

const Rational::Number& Rational::number() const {
  static const Number kZero{};
  return number_ ? *number_ : kZero;
}

int Rational::Sign() const { return sgn(number().q); }

double Rational::RoundedUp() const { return NeighboursOf(number().q).above; }
double Rational::RoundedDown() const { return NeighboursOf(number().q).below; }

double Rational::Nearest() const {
  const mpq_class& q = number().q;
  const auto [below, above] = NeighboursOf(q);
  if (std::isinf(above)) return below;
  if (std::isinf(below)) return above;
  return q - mpq_class(below) <= mpq_class(above) - q ? below : above;
}

std::optional<double> Rational::Exactly() const {
  const auto [below, above] = NeighboursOf(number().q);
  if (below != above) return std::nullopt;
  return below;
}

Rational Rational::Numerator() const { return Rational(Number{mpq_class(number().q.get_num())}); }
Rational Rational::Denominator() const { return Rational(Number{mpq_class(number().q.get_den())}); }

Rational operator-(const Rational& a) { return Rational(Rational::Number{-a.number().q}); }

Rational operator+(const Rational& a, const Rational& b) {
  if (a.IsZero()) return b;
  if (b.IsZero()) return a;
  return Rational(Rational::Number{a.number().q + b.number().q});
}

Rational operator-(const Rational& a, const Rational& b) {
  if (b.IsZero()) return a;
  return Rational(Rational::Number{a.number().q - b.number().q});
}

Rational operator*(const Rational& a, const Rational& b) {
  if (a.IsZero() || b.IsZero()) return {};
  return Rational(Rational::Number{a.number().q * b.number().q});
}

Rational operator/(const Rational& a, const Rational& b) {
  ASSAY_CHECK(!b.IsZero(), "division by 0");
  return Rational(Rational::Number{a.number().q / b.number().q});
}

bool operator==(const Rational& a, const Rational& b) {
  return a.number_ == b.number_ || a.number().q == b.number().q;
}

std::strong_ordering operator<=>(const Rational& a, const Rational& b) {
  return cmp(a.number().q, b.number().q) <=> 0;
}

Rational Abs(const Rational& a) { return a.Sign() < 0 ? -a : a; }

}  // namespace assay::numeric
