#include "sim/sense/overhead_eyes.h"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <cmath>

#include "planner/base/check.h"

namespace assay::sense {
namespace {

constexpr int kPixels = 480;  // along each side of a picture

// Returns the positions of the camera's eyes in the world frame. They do not move with the
// simulation.
std::vector<Vector3> EyesOf(const scene::Scene& scene) {
  std::vector<Vector3> eyes;
  const mujoco::Model& model = scene.model();
  for (int number = 1;; ++number) {
    const auto camera = model.FindCamera(fmt::format("overhead-eye-{}", number));
    if (camera.IsNone()) break;
    eyes.emplace_back(Eigen::Map<const Vector3>(model.get()->cam_pos + 3 * camera.index()));
  }
  ASSAY_CHECK(eyes.size() >= 2, "{} eyes", eyes.size());
  return eyes;
}

// A ball about the middle of a part's hull that holds the part at every pose in the search window.
struct Ball {
  Vector3 center;  // metres, world frame
  double radius = 0;
};

Ball BallAround(const domain::PartModel& model, const Pose& believed, const SearchWindow& window) {
  Vector3 low = model.corners().front();
  Vector3 high = low;
  for (const Vector3& vertex : model.corners()) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  const Vector3 middle = (low + high) / 2;
  const double lever = middle.norm();
  const double way = std::sqrt(2.0) * window.distance + window.height + lever * window.yaw;
  return {believed * middle, (high - low).norm() / 2 + way};
}

}  // namespace

OverheadEyes::OverheadEyes(const scene::Scene& scene, const domain::Problem& problem,
                           const SearchWindow& window)
    : problem_(problem),
      window_(window),
      eyes_(EyesOf(scene)),
      renderer_(scene.model(), kPixels, kPixels, {.effects = render::Effects::kNone}) {}

std::vector<Sight> OverheadEyes::LookAt(const mujoco::Data& data, PartId part,
                                        const Pose& believed) {
  const Ball ball = BallAround(*problem_.part(part).model, believed, window_);
  std::vector<Sight> sights;
  for (const Vector3& eye : eyes_) {
    const View view(eye, ball.center, ball.radius, kPixels);
    sights.push_back({view, renderer_.Render(data, view.camera())});
  }
  return sights;
}

}  // namespace assay::sense
