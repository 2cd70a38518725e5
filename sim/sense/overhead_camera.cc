#include "sim/sense/overhead_camera.h"

#include <algorithm>
#include <cmath>

#include "sim/sense/fitting/placement_search.h"

namespace assay::sense {
namespace {

constexpr SearchWindow kWindow;
// The limits for an accepted fit. A part in clear view has 0.9 of its contour found, a residual of
// 0.06 pixels, and deviations of 0.006 mm and 0.005 degrees. True errors reach eight deviations,
// because edges along the rows of pixels all have the same error. The outline of an upright can
// shows little of its yaw, whose deviation is 0.014 degrees.
constexpr double kLeastFound = 0.4;                                // fraction of the contour
constexpr double kGreatestResidual = 0.12;                         // pixels
const Displacement kGreatestDeviation(12e-6, 12e-6, 30e-6, 2e-4);  // metres, radians

bool InWindow(const Displacement& d) {
  return d.head<2>().cwiseAbs().maxCoeff() <= kWindow.distance &&
         std::abs(d[2]) <= kWindow.height && std::abs(d[3]) <= kWindow.yaw;
}

bool IsGood(const PoseFit& fit) {
  return fit.found >= kLeastFound && fit.residual <= kGreatestResidual &&
         (fit.deviation.array() <= kGreatestDeviation.array()).all() && InWindow(fit.displacement);
}

}  // namespace

OverheadCamera::OverheadCamera(const scene::Scene& scene, const domain::Problem& problem)
    : problem_(problem), palette_(scene), eyes_(scene, problem, kWindow) {}

std::vector<Picture> OverheadCamera::Look(const mujoco::Data& data, PartId part,
                                          const Pose& believed) {
  std::vector<Picture> pictures;
  for (Sight& sight : eyes_.LookAt(data, part, believed)) {
    SurfaceMap surfaces = palette_.Segment(sight.image, part);
    pictures.push_back({sight.view, std::move(sight.image), std::move(surfaces)});
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
