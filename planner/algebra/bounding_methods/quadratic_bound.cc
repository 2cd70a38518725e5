#include "planner/algebra/bounding_methods/quadratic_bound.h"

#include <algorithm>
#include <cmath>

namespace assay::algebra {
namespace {

constexpr int kShiftHalvings = 5;  // bisections in the search for the least shift
constexpr int kSweeps = 4;

}  // namespace

void QuadraticBound::SetCurvature(const numeric::SymmetricMatrix& curvature, double error,
                                  std::span<const double> widths) {
  const int n = curvature.size();
  widths_.assign(widths.begin(), widths.end());
  matrix_.Reset(n);
  deviation_.Reset(n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j <= i; ++j) {
      const double area = widths[i] * widths[j];
      matrix_(i, j) = -curvature(i, j) * area;
      deviation_(i, j) = (error + 0x1p-50 * std::abs(curvature(i, j))) * area * (1 + 1e-12);
    }
  }
  FindShift();
}

bool QuadraticBound::IsEnough(double shift) {
  shifted_ = matrix_;
  for (int i = 0; i < shifted_.size(); ++i) shifted_(i, i) += shift;
  return IsSurelyPositiveDefinite(shifted_, deviation_);
}

void QuadraticBound::FindShift() {
  shift_ = 0;
  if (IsEnough(0)) return;
  double too_little = 0;
  double enough = 1e-290;
  for (int i = 0; i < matrix_.size(); ++i) {  // by Gershgorin's circles
    double radius = 0;
    for (int j = 0; j < matrix_.size(); ++j) {
      radius += j == i ? -matrix_(i, i) : std::abs(matrix_(std::max(i, j), std::min(i, j)));
    }
    enough = std::max(enough, radius * (1 + 1e-6));
  }
  while (!IsEnough(enough)) enough *= 2;
  for (int i = 0; i < kShiftHalvings; ++i) {
    const double middle = (too_little + enough) / 2;
    (IsEnough(middle) ? enough : too_little) = middle;
  }
  shift_ = enough;
}

// Returns the derivative, with respect to coordinate i, of the shifted quadratic function at
// place_.
double QuadraticBound::Slope(int i) const {
  double slope = slopes_[i] - shift_ * place_[i];
  for (int j = 0; j < matrix_.size(); ++j) {
    slope -= matrix_(std::max(i, j), std::min(i, j)) * place_[j];
  }
  return slope;
}

// The shifted function is concave, so its tangent plane at any place is nowhere below it. The place
// is moved near the maximum, coordinate by coordinate.
double QuadraticBound::Most(std::span<const double> slopes) {
  const int n = matrix_.size();
  slopes_.resize(n);
  place_.assign(n, 0);
  for (int i = 0; i < n; ++i) slopes_[i] = slopes[i] * widths_[i];
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (int i = 0; i < n; ++i) {
      const double step = Slope(i) / (matrix_(i, i) + shift_);
      place_[i] = std::clamp(place_[i] + step, -0.5, 0.5);
    }
  }
  double most = shift_ * n / 8;
  double magnitude = most;
  for (int i = 0; i < n; ++i) {
    const double slope = Slope(i);
    // The value of the shifted function at place_ p is p . (slopes + Slope(p)) / 2.
    most += place_[i] * (slopes_[i] + slope) / 2;
    most += std::max(slope * (0.5 - place_[i]), slope * (-0.5 - place_[i]));
    magnitude += std::abs(slopes_[i]) + std::abs(slope);
    for (int j = 0; j <= i; ++j) magnitude += std::abs(matrix_(i, j)) + deviation_(i, j);
  }
  return most + 1e-14 * magnitude;
}

}  // namespace assay::algebra
