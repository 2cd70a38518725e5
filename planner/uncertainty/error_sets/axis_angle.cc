#include "planner/uncertainty/error_sets/axis_angle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace assay::uncertainty {
namespace {

constexpr double kRoundedAway = 1e-12;

}  // namespace

Vector3 VerticalInTool(const Pose& X_WorldTool) {
  Vector3 up = X_WorldTool.linear().row(2).transpose();
  for (double& component : up) {
    if (std::abs(component) < kRoundedAway) component = 0;
    if (std::abs(component) > 1 - kRoundedAway) component = std::copysign(1.0, component);
  }
  return up;
}

double TwistOf(double angle, double cosine) {
  if (angle >= std::numbers::pi) return cosine == 0 ? 0 : std::numbers::pi;
  return 2 * std::atan(std::tan(angle / 2) * std::abs(cosine));
}

double SwingOf(double angle, double cosine) {
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  return 2 * std::asin(std::sin(std::min(angle, std::numbers::pi) / 2) * sine);
}

}  // namespace assay::uncertainty
