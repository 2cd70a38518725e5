#include "sim/sense/overhead_camera.h"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>

#include "planner/base/check.h"
#include "sim/sense/placement_search.h"

namespace assay::sense {
namespace {

constexpr int kPixels = 480;  // along each side of a picture
constexpr SearchWindow kWindow;
// What is accepted. Parts in clear view have 0.9 of their contour found, residuals of 0.1 pixels,
// and deviations of 0.006 mm and 0.006 degrees; ten times the greatest accepted is within the
// promise.
constexpr double kLeastFound = 0.4;           // of the contour
constexpr double kGreatestResidual = 0.25;    // pixels
constexpr double kGreatestDeviation = 15e-6;  // metres
constexpr double kGreatestYawDeviation = 3e-4;

// They stand in the world and do not move with the simulation.
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

// A ball about the middle of a part's hull that holds the part wherever in the window it is.
struct Ball {
  Vector3 center;  // world
  double radius = 0;
};

Ball BallAround(const domain::PartModel& model, const Pose& believed) {
  Vector3 low = model.hull().vertices.front();
  Vector3 high = low;
  for (const Vector3& vertex : model.hull().vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  const Vector3 middle = (low + high) / 2;
  const double lever = middle.norm();
  const double way = std::sqrt(2.0) * kWindow.distance + kWindow.height + lever * kWindow.yaw;
  return {believed * middle, (high - low).norm() / 2 + way};
}

bool InWindow(const Displacement& d) {
  return d.head<2>().cwiseAbs().maxCoeff() <= kWindow.distance &&
         std::abs(d[2]) <= kWindow.height && std::abs(d[3]) <= kWindow.yaw;
}

bool IsGood(const PoseFit& fit) {
  return fit.found >= kLeastFound && fit.residual <= kGreatestResidual &&
         fit.deviation.head<2>().maxCoeff() <= kGreatestDeviation &&
         fit.deviation[3] <= kGreatestYawDeviation && InWindow(fit.displacement);
}

}  // namespace

OverheadCamera::OverheadCamera(const scene::Scene& scene, const domain::Problem& problem)
    : problem_(problem),
      eyes_(EyesOf(scene)),
      palette_(scene),
      renderer_(scene.model(), kPixels, kPixels, render::Effects::kNone) {}

std::vector<Picture> OverheadCamera::Look(const mujoco::Data& data, PartId part,
                                          const Pose& believed) {
  const Ball ball = BallAround(*problem_.part(part).model, believed);
  std::vector<Picture> pictures;
  for (const Vector3& eye : eyes_) {
    const View view(eye, ball.center, ball.radius, kPixels);
    render::Image image = renderer_.Render(data, view.camera());
    SurfaceMap surfaces = palette_.Segment(image, part);
    pictures.push_back({view, std::move(image), std::move(surfaces)});
  }
  return pictures;
}

PoseFit OverheadCamera::Fit(std::span<const Picture> pictures, PartId part,
                            const Pose& believed) const {
  const domain::PartModel& model = *problem_.part(part).model;
  return FitPose(pictures, model, believed, CoarsePlacement(pictures, model, believed, kWindow));
}

std::optional<Pose> OverheadCamera::Measure(const mujoco::Data& data, PartId part,
                                            const Pose& believed) {
  const PoseFit fit = Fit(Look(data, part, believed), part, believed);
  if (!IsGood(fit)) return std::nullopt;
  return Displaced(believed, fit.displacement);
}

}  // namespace assay::sense
