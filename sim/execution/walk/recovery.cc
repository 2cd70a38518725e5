#include "sim/execution/walk/recovery.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/base/check.h"

namespace assay::execution {
namespace {

std::vector<Vector3> GrowingCircles(double radius, double pitch, const Vector3& axis) {
  constexpr double kTau = 2 * std::numbers::pi;
  const Vector3 u = axis.unitOrthogonal();
  const Vector3 v = axis.cross(u);
  std::vector<Vector3> places;
  const int circles = static_cast<int>(std::floor(radius / pitch + 1e-9));
  for (int c = 1; c <= circles; ++c) {
    const int count = static_cast<int>(std::ceil(kTau * c));
    for (int i = 0; i < count; ++i) {
      const double angle = kTau * i / count;
      places.push_back(c * pitch * (std::cos(angle) * u + std::sin(angle) * v));
    }
  }
  return places;
}

}  // namespace

std::vector<Vector3> PlacesToTry(const plan::Recovery& recovery, const Vector3& axis) {
  switch (recovery.strategy) {
    case domain::RecoveryStrategy::kGropingSearch:
      return GrowingCircles(recovery.radius, recovery.pitch, axis);
    case domain::RecoveryStrategy::kRetry:
      return std::vector<Vector3>(kRetries, Vector3::Zero());
    case domain::RecoveryStrategy::kCallOperator:
      return {};
  }
  ASSAY_CHECK(false, "a strategy that the switch does not know");
  return {};
}

}  // namespace assay::execution
