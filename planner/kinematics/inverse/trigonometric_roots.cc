#include "planner/kinematics/inverse/trigonometric_roots.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace assay::kinematics {
namespace {

// A discriminant that is negative by at most this part of its terms counts as zero. The root is
// then a place where the function nearly vanishes, from which iterations may start.
constexpr double kDoubleRoot = 1e-2;

// Returns the greatest real root of z^3 + a z^2 + b z + c.
double GreatestCubicRoot(double a, double b, double c) {
  const double q = (a * a - 3 * b) / 9;
  const double r = (a * (2 * a * a - 9 * b) + 27 * c) / 54;
  double z = 0;
  if (r * r < q * q * q) {
    const double angle = std::acos(std::clamp(r / std::sqrt(q * q * q), -1.0, 1.0));
    z = -2 * std::sqrt(q) * std::cos((angle + 2 * std::numbers::pi) / 3) - a / 3;
  } else {
    const double radical = std::cbrt(std::abs(r) + std::sqrt(std::max(0.0, r * r - q * q * q)));
    const double u = r > 0 ? -radical : radical;
    z = u + (u == 0 ? 0 : q / u) - a / 3;
  }
  for (int i = 0; i < 2; ++i) {
    const double slope = (3 * z + 2 * a) * z + b;
    if (slope > 0) z -= (((z + a) * z + b) * z + c) / slope;
  }
  return z;
}

// Adds the real roots of y^2 + b y + c, moved by `shift`.
void AddQuadraticRoots(double b, double c, double shift, BoundedList<double, 4>& roots) {
  const double discriminant = b * b - 4 * c;
  if (discriminant < -kDoubleRoot * (b * b + std::abs(4 * c) + kDoubleRoot)) return;
  const double root = std::sqrt(std::max(0.0, discriminant));
  roots.push_back(shift + (-b - root) / 2);
  roots.push_back(shift + (-b + root) / 2);
}

// Returns the real roots of x^4 + a x^3 + b x^2 + c x + d by Ferrari's method.
BoundedList<double, 4> QuarticRoots(double a, double b, double c, double d) {
  const double p = b - 3 * a * a / 8;
  const double q = c - a * b / 2 + a * a * a / 8;
  const double r = d - a * c / 4 + a * a * b / 16 - 3 * a * a * a * a / 256;
  const double z = std::max(0.0, GreatestCubicRoot(2 * p, p * p - 4 * r, -q * q));
  const double s = std::sqrt(z);
  BoundedList<double, 4> roots;
  // The quartic of y = x + a / 4 is the product of two quadratics. Their constants have the sum
  // p + z, the product r, and the difference q / s. Without s, the product tells the difference.
  const double radicand = std::max(0.0, (p + z) * (p + z) - 4 * r);
  const double difference = s < 1e-4 ? std::copysign(std::sqrt(radicand), q) : q / s;
  AddQuadraticRoots(s, (p + z - difference) / 2, -a / 4, roots);
  AddQuadraticRoots(-s, (p + z + difference) / 2, -a / 4, roots);
  return roots;
}

// The angle in [-pi, pi].
double Wrapped(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

double Polished(const TrigonometricQuadratic& f, double angle) {
  double value = f.At(angle);
  for (int i = 0; i < 3; ++i) {
    const double next = angle - value / f.SlopeAt(angle);
    if (!(std::abs(next - angle) < 0.1)) break;
    const double next_value = f.At(next);
    if (!(std::abs(next_value) < std::abs(value))) break;
    angle = next;
    value = next_value;
  }
  return angle;
}

// Returns the multiple of 45 degrees at which the function is farthest from zero.
double FarthestFromZero(const TrigonometricQuadratic& f) {
  const double d = std::numbers::sqrt2 / 2;
  const double odd[4] = {(f.cosine + f.sine) * d, (f.sine - f.cosine) * d, -(f.cosine + f.sine) * d,
                         (f.cosine - f.sine) * d};
  const double even[4] = {f.cosine, f.sine, -f.cosine, -f.sine};
  double best = -1;
  int best_index = 0;
  for (int i = 0; i < 8; ++i) {
    const int half = i / 2;
    const double second = (half % 2 == 0 ? 1 : -1) * (i % 2 == 0 ? f.cosine2 : f.sine2);
    const double value = std::abs(f.constant + (i % 2 == 0 ? even[half] : odd[half]) + second);
    if (value <= best) continue;
    best = value;
    best_index = i;
  }
  return best_index * std::numbers::pi / 4;
}

}  // namespace

double TrigonometricQuadratic::At(double angle) const {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return constant + cosine * c + sine * s + cosine2 * (c * c - s * s) + sine2 * 2 * c * s;
}

double TrigonometricQuadratic::SlopeAt(double angle) const {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return sine * c - cosine * s + 2 * (sine2 * (c * c - s * s) - cosine2 * 2 * c * s);
}

BoundedList<double, 4> RootsOf(const TrigonometricQuadratic& f) {
  // The angle is measured from `origin`. Half a turn from there, where the tangent is infinite, the
  // function is farthest from zero.
  const double origin = FarthestFromZero(f) - std::numbers::pi;
  const double c = std::cos(origin);
  const double s = std::sin(origin);
  const double c2 = c * c - s * s;
  const double s2 = 2 * c * s;
  const double b1 = f.cosine * c + f.sine * s;
  const double b2 = f.sine * c - f.cosine * s;
  const double b3 = f.cosine2 * c2 + f.sine2 * s2;
  const double b4 = f.sine2 * c2 - f.cosine2 * s2;
  const double leading = f.constant - b1 + b3;
  BoundedList<double, 4> angles;
  if (leading == 0) return angles;
  for (const double t :
       QuarticRoots((2 * b2 - 4 * b4) / leading, (2 * f.constant - 6 * b3) / leading,
                    (2 * b2 + 4 * b4) / leading, (f.constant + b1 + b3) / leading)) {
    angles.push_back(Wrapped(Polished(f, origin + 2 * std::atan(t))));
  }
  return angles;
}

}  // namespace assay::kinematics
