#include "sim/render/framing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/base/check.h"

namespace assay::render {
namespace {

constexpr double kVerticalAngle = 0.5;  // radians: perspective is weak
constexpr double kMargin = 1.1;         // the picture beside what must be in it

// Where the eye must be for all balls to lie between two sides of the picture.
struct Between {
  double middle = 0;    // along the axis from side to side
  double distance = 0;  // along the axis to the eye, at least
};

// A ball lies inside of a side plane through the eye if its centre is at least a radius inside.
// With the eye at distance d, that bounds the eye's place across by U - d tan from below and L + d
// tan from above, and these meet at the least d.
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
  for (const Vector3& vertex : model.hull().vertices) corners.push_back({X_WorldPart * vertex});
  return corners;
}

}  // namespace assay::render
