#include "sim/render/close_up.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace assay::render {
namespace {

constexpr int kAround = 24;
constexpr double kLowest = 0.17;   // least z of a direction: ten degrees above the table
constexpr double kHighest = 0.95;  // greatest z: a view from straight above has no upward direction

std::vector<Vector3> Directions(const Subject& subject) {
  const Vector3& out = subject.out;
  const Vector3 x = out.unitOrthogonal();
  const Vector3 y = out.cross(x);
  std::vector<Vector3> directions;
  for (const double from_out : subject.from_out) {
    for (int i = 0; i < kAround; ++i) {
      const double around = 2 * std::numbers::pi * i / kAround;
      const Vector3 back = std::cos(from_out) * out +
                           std::sin(from_out) * (std::cos(around) * x + std::sin(around) * y);
      if (back.z() > kLowest && back.z() < kHighest) directions.push_back(back);
    }
  }
  return directions;
}

}  // namespace

Vector3 UsualDirection() { return Vector3(0.8, -0.75, 0.6).normalized(); }

FreeCamera CloseUp(const Subject& subject, const Sight& sight, double aspect) {
  FreeCamera best = Framing(subject.framed, UsualDirection(), aspect);
  std::pair<std::ptrdiff_t, double> most = {-1, 0};
  for (const Vector3& back : Directions(subject)) {
    const FreeCamera camera = Framing(subject.framed, back, aspect);
    const Vector3 eye = camera.X_WorldCamera.translation();
    const auto seen = std::ranges::count_if(subject.seen, [&](const Glimpse& glimpse) {
      return sight.Sees(eye, glimpse.point, glimpse.moved);
    });
    const std::pair worth{seen, back.dot(UsualDirection())};
    if (worth <= most) continue;
    most = worth;
    best = camera;
  }
  return best;
}

}  // namespace assay::render
