#include "planner/numeric/interval_arithmetic.h"

#include <numbers>

namespace assay {

namespace {

using interval_detail::kLargest;
using interval_detail::ZeroIfNaN;

constexpr double kTiniest = std::numeric_limits<double>::denorm_min();
// Above this magnitude nothing underflows, so the rounding error of a product is itself a double.
constexpr double kSmallestSafeProduct = 0x1p-960;
// A lower bound of pi: the double nearest to pi is below it.
constexpr double kPiFromBelow = std::numbers::pi;

bool IsExactProduct(double a, double b, double product) {
  if (a == 0 || b == 0 || std::abs(a) == 1 || std::abs(b) == 1) return true;
  const double size = std::abs(product);
  return kSmallestSafeProduct < size && size <= kLargest && std::fma(a, b, -product) == 0;
}

bool HasFactorsOfOppositeSign(const Interval& a, const Interval& b) {
  return (a.low < 0 && b.high > 0) || (a.high > 0 && b.low < 0);
}

bool HasFactorsOfEqualSign(const Interval& a, const Interval& b) {
  return (a.low < 0 && b.low < 0) || (a.high > 0 && b.high > 0);
}

Interval QuotientOfSingles(double a, double b) {
  const double quotient = a / b;
  if (IsExactProduct(quotient, b, a) && quotient * b == a) {
    return {quotient + 0.0, quotient + 0.0};  // + 0.0 avoids -0
  }
  if (quotient == 0) return interval_detail::RoundedFromZeroEnds({a, a}, {b, b}, {0, 0});
  return {RoundedDown(quotient), RoundedUp(quotient)};
}

// Returns x^n for x >= 0. Each product is rounded by `round`.
template <double (*round)(double)>
double PowerOfMagnitude(double x, int n) {
  double result = 1;
  double square = x;
  for (unsigned rest = static_cast<unsigned>(n);;) {
    if ((rest & 1U) != 0) result = result == 1 ? square : std::max(0.0, round(result * square));
    rest >>= 1U;
    if (rest == 0) return result;
    square = std::max(0.0, round(square * square));
  }
}

double PowerFromBelow(double x, int n) {
  if (x == 0 || x == 1) return x;
  if (n == 2) return std::max(0.0, RoundedDown(x * x));
  return PowerOfMagnitude<&RoundedDown>(x, n);
}

double PowerFromAbove(double x, int n) {
  if (x == 0 || x == 1) return x;
  if (n == 2) return RoundedUp(x * x);
  return PowerOfMagnitude<&RoundedUp>(x, n);
}

Interval PowerOfSingle(double x, int n) {
  Interval result = kOne;
  Interval square = {x, x};
  for (unsigned rest = static_cast<unsigned>(n);;) {
    if ((rest & 1U) != 0) result = result == kOne ? square : result * square;
    rest >>= 1U;
    if (rest == 0) return result;
    square = square * square;
  }
}

Interval PowerOfMagnitudes(const Interval& a, int n) {
  return {PowerFromBelow(a.low, n), PowerFromAbove(a.high, n)};
}

Interval PositivePower(const Interval& a, int n) {
  if (n == 1) return a;
  if (IsSingle(a)) {
    const Interval power = PowerOfSingle(std::abs(a.low), n);
    return a.low < 0 && n % 2 != 0 ? -power : power;
  }
  if (n % 2 == 0) return PowerOfMagnitudes(Abs(a), n);
  if (a.low >= 0) return PowerOfMagnitudes(a, n);
  if (a.high <= 0) return -PowerOfMagnitudes(-a, n);
  return {-PowerFromAbove(-a.low, n), PowerFromAbove(a.high, n)};
}

// The C library's sine and cosine are within one unit in the last place. These functions return
// bounds that the true values never cross.
double SinFromBelow(double x) {
  const double sine = std::sin(x);
  const double least = sine >= 0 ? 0 : -1;  // the computed sign is always right
  return std::max(least, RoundedDown(RoundedDown(sine)));
}
double SinFromAbove(double x) { return 0 - SinFromBelow(-x); }

double CosFromBelow(double x) {
  return x == 0 ? 1 : std::max(-1.0, RoundedDown(RoundedDown(std::cos(x))));
}
double CosFromAbove(double x) {
  return x == 0 ? 1 : std::min(1.0, RoundedUp(RoundedUp(std::cos(x))));
}

// Describes a function f, a sine shifted by any phase, at the ends of an interval: bounds of its
// values, and its slopes there. The range of f follows from these. The signs of the slopes are
// right, because no double other than 0 is so near a zero of sine or cosine that the C library
// would return the wrong sign.
struct SinusoidEnds {
  Interval at_low, at_high;  // they contain the values of f at the ends
  double slope_at_low = 0;
  double slope_at_high = 0;
};

Interval RangeOfSinusoid(const SinusoidEnds& ends, double width) {
  const Interval hull = Hull(ends.at_low, ends.at_high);
  // The slope has at most one zero over a length below pi, and at most two below 2 pi. Its sign
  // changes only if the number of zeros is odd.
  if (ends.slope_at_low > 0 && ends.slope_at_high < 0) return {hull.low, 1};
  if (ends.slope_at_low < 0 && ends.slope_at_high > 0) return {-1, hull.high};
  const bool is_zero_at_an_end = ends.slope_at_low == 0 || ends.slope_at_high == 0;
  if (width < kPiFromBelow && !is_zero_at_an_end) return hull;
  return {-1, 1};
}

}  // namespace

namespace interval_detail {

Interval ProductOfSingles(double a, double b) {
  const double product = ZeroIfNaN(a * b);
  if (IsExactProduct(a, b, product)) return {product + 0.0, product + 0.0};  // + 0.0 avoids -0
  if (product == 0) return RoundedFromZeroEnds({a, a}, {b, b}, {0, 0});
  return {RoundedDown(product), RoundedUp(product)};
}

Interval RoundedFromZeroEnds(const Interval& a, const Interval& b, const Interval& computed) {
  Interval result = {RoundedDown(computed.low), RoundedUp(computed.high)};
  if (computed.low == 0) result.low = HasFactorsOfOppositeSign(a, b) ? -kTiniest : 0;
  if (computed.high == 0) result.high = HasFactorsOfEqualSign(a, b) ? kTiniest : 0;
  return result;
}

}  // namespace interval_detail

Interval operator/(const Interval& a, const Interval& b) {
  if (b.low <= 0 && b.high >= 0) return kWholeLine;
  if (IsSingle(a) && IsSingle(b)) return QuotientOfSingles(a.low, b.low);
  // A quotient infinity / infinity stands for a set of values that comes near 0. Its NaN is
  // therefore replaced by 0. One of the other three quotients is the other end of this set.
  const double ll = ZeroIfNaN(a.low / b.low);
  const double lh = ZeroIfNaN(a.low / b.high);
  const double hl = ZeroIfNaN(a.high / b.low);
  const double hh = ZeroIfNaN(a.high / b.high);
  const double low = std::min(std::min(ll, lh), std::min(hl, hh));
  const double high = std::max(std::max(ll, lh), std::max(hl, hh));
  if (low == 0 || high == 0) return interval_detail::RoundedFromZeroEnds(a, b, {low, high});
  return {RoundedDown(low), RoundedUp(high)};
}

Interval Power(const Interval& a, int n) {
  if (n == 0) return kOne;
  if (n > 0) return PositivePower(a, n);
  if (n == std::numeric_limits<int>::min()) return kOne / (PositivePower(a, -(n + 1)) * a);
  return kOne / PositivePower(a, -n);
}

Interval Sin(const Interval& a) {
  constexpr double kQuarterTurn = kPiFromBelow / 2;
  if (-kQuarterTurn <= a.low && a.high <= kQuarterTurn) {
    return {SinFromBelow(a.low), SinFromAbove(a.high)};
  }
  const double width = Width(a);
  if (!(width < 2 * kPiFromBelow)) return {-1, 1};
  if (width == 0) return {SinFromBelow(a.low), SinFromAbove(a.low)};
  return RangeOfSinusoid({.at_low = {SinFromBelow(a.low), SinFromAbove(a.low)},
                          .at_high = {SinFromBelow(a.high), SinFromAbove(a.high)},
                          .slope_at_low = std::cos(a.low),
                          .slope_at_high = std::cos(a.high)},
                         width);
}

Interval Cos(const Interval& a) {
  if (-kPiFromBelow <= a.low && a.high <= kPiFromBelow) {
    const Interval size = Abs(a);
    return {CosFromBelow(size.high), CosFromAbove(size.low)};
  }
  const double width = Width(a);
  if (!(width < 2 * kPiFromBelow)) return {-1, 1};
  if (width == 0) return {CosFromBelow(a.low), CosFromAbove(a.low)};
  return RangeOfSinusoid({.at_low = {CosFromBelow(a.low), CosFromAbove(a.low)},
                          .at_high = {CosFromBelow(a.high), CosFromAbove(a.high)},
                          .slope_at_low = -std::sin(a.low),
                          .slope_at_high = -std::sin(a.high)},
                         width);
}

Interval Sqrt(const Interval& a) {
  if (a.high < 0) return kWholeLine;
  const Interval part = {std::max(a.low, 0.0), a.high};
  Interval root = {std::sqrt(part.low), std::sqrt(part.high)};
  if (!IsExactProduct(root.low, root.low, part.low) || root.low * root.low != part.low) {
    root.low = RoundedDown(root.low);
  }
  if (!IsExactProduct(root.high, root.high, part.high) || root.high * root.high != part.high) {
    root.high = RoundedUp(root.high);
  }
  return root;
}

Interval Abs(const Interval& a) {
  if (a.low >= 0) return a;
  if (a.high <= 0) return -a;
  return {0, std::max(-a.low, a.high)};
}

double Width(const Interval& a) { return (a - a).high; }

double Midpoint(const Interval& a) {
  if (a == kWholeLine) return 0;
  if (a.low == -kInfinity) return -Midpoint(-a);
  if (a.high == kInfinity) {
    // The result is greater than twice the low end, so that repeated bisection reaches large
    // numbers soon.
    return a.low < 0 ? 0 : std::min(2 * a.low + 1, kLargest);
  }
  const double sum = a.low + a.high;
  const double middle = std::abs(sum) <= kLargest ? sum / 2 : a.low / 2 + a.high / 2;
  return std::clamp(middle, a.low, a.high);
}

}  // namespace assay
