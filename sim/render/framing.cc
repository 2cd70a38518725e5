#include "sim/render/framing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/base/check.h"
#include "planner/geometry/pose.h"

namespace assay::render {
namespace {

constexpr double kVerticalAngle = 0.5;  // radians, small so that the perspective is weak
constexpr double kMargin = 1.1;         // size of the picture relative to what it must show

// The place of the eye for which all balls lie between two opposite sides of the picture, metres.
struct Between {
  double middle = 0;    // coordinate along the axis from side to side
  double distance = 0;  // least coordinate along the axis to the eye
};

// A ball lies inside a side plane through the eye if its centre is at least its radius inside. For
// an eye at distance d this bounds the eye's coordinate across: it is at least upper - d tangent
// and at most lower + d tangent. The two bounds meet at the least d.
Between BetweenSides(std::span<const Ball> balls, const Vector3& across, const Vector3& back,
                     double tangent) {
  const double cosine = 1 / std::hypot(1.0, tangent);
  double upper = -std::numeric_limits<double>::infinity();
  double lower = -upper;
  for (const Ball& ball : balls) {
    const double reach = ball.center.dot(back) * tangent + ball.radius / cosine;
    upper = std::max(upper, ball.center.dot(across) + reach);
    lower = std::min(lower, ball.center.dot(across) - reach);
  }
  return {(upper + lower) / 2, (upper - lower) / (2 * tangent)};
}

}  // namespace

FreeCamera Framing(std::span<const Ball> balls, const Vector3& back, double aspect) {
  ASSAY_CHECK(!balls.empty() && aspect > 0);
  const Vector3 right = Vector3::UnitZ().cross(back).normalized();
  const Vector3 up = back.cross(right);
  const double tangent = std::tan(kVerticalAngle / 2) / kMargin;
  const Between sides = BetweenSides(balls, right, back, aspect * tangent);
  const Between ends = BetweenSides(balls, up, back, tangent);
  const Vector3 eye =
      sides.middle * right + ends.middle * up + std::max(sides.distance, ends.distance) * back;
  return {geometry::PoseFromColumns(right, up, back, eye), kVerticalAngle};
}

std::vector<Ball> CornersOf(const domain::PartModel& model, const Pose& X_WorldPart) {
  std::vector<Ball> corners;
  for (const Vector3& vertex : model.corners()) corners.push_back({X_WorldPart * vertex});
  return corners;
}

}  // namespace assay::render
