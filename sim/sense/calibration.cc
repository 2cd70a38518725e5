#include "sim/sense/calibration.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "planner/base/random.h"
#include "planner/domain/resting/resting.h"
#include "sim/scene/scene.h"

namespace assay::sense {
namespace {

using domain::PlacedPart;
using domain::Problem;

constexpr int kMostDraws = 10'000;
constexpr double kDegree = std::numbers::pi / 180;

Eigen::AlignedBox2d BoxAround(const geometry::Polygon& polygon) {
  Eigen::AlignedBox2d box;
  for (const geometry::Vector2& corner : polygon) box.extend(corner);
  return box;
}

Pose DrawPose(const domain::PartModel& model, domain::StablePoseId resting,
              const Eigen::AlignedBox2d& places, RandomStream& random) {
  const double x = random.Uniform(places.min().x(), places.max().x());
  const double y = random.Uniform(places.min().y(), places.max().y());
  const double yaw = random.Uniform(-std::numbers::pi, std::numbers::pi);
  return domain::Placement{x, y, yaw}.X_WorldTable() *
         model.stable_poses()[resting.index()].X_TablePart;
}

Displacement DrawDisplacement(bool at_corner, RandomStream& random) {
  Displacement drawn;
  for (int i = 0; i < 4; ++i) {
    const double side = random.Uniform(-1, 1);
    drawn[i] = CalibratedDisplacement()[i] * (at_corner ? std::copysign(1.0, side) : side);
  }
  return drawn;
}

}  // namespace

Pose CalibrationPlacement::Believed() const {
  return Displaced(X_WorldPart[part.index()], -displacement);
}

const Displacement& CalibratedDisplacement() {
  static const Displacement kBounds(0.010, 0.010, 0.003, 8 * kDegree);
  return kBounds;
}

std::optional<CalibrationPlacement> DrawCalibrationPlacement(const Problem& problem,
                                                             std::uint64_t seed, int number) {
  RandomStream random(seed, fmt::format("calibrate/{}/{}", problem.name, number));
  const Eigen::AlignedBox2d places = BoxAround(problem.workcell->table().top);
  const bool at_corner = number % 2 == 0;
  CalibrationPlacement placement{.part =
                                     PartId(random.Index(static_cast<int>(problem.parts.size())))};
  std::vector<PlacedPart> placed;
  int draws = 0;
  for (std::size_t i = 0; i < problem.parts.size(); ++i) {
    const PartId part(i);
    const domain::PartModel& model = *problem.part(part).model;
    const domain::StablePoseId resting(random.Index(static_cast<int>(model.stable_poses().size())));
    Pose X_WorldPart;
    do {
      if (++draws > kMostDraws) return std::nullopt;
      X_WorldPart = DrawPose(model, resting, places, random);
    } while (!OnTable(problem, part, X_WorldPart) ||
             !Crowding(problem, part, X_WorldPart, placed).IsNone());
    placed.push_back({.part = part, .X_WorldPart = X_WorldPart});
    const Displacement displacement = DrawDisplacement(at_corner, random);
    X_WorldPart.translation().z() += displacement[2];
    placement.X_WorldPart.push_back(X_WorldPart);
    if (part != placement.part) continue;
    placement.resting = resting;
    placement.displacement = displacement;
  }
  return placement;
}

std::optional<Displacement> MeasuredError(const scene::Scene& scene,
                                          const CalibrationPlacement& placement,
                                          PoseSensor& sensor) {
  mujoco::Data data = scene.Start();
  for (std::size_t i = 0; i < placement.X_WorldPart.size(); ++i) {
    scene.SetPart(data, PartId(i), placement.X_WorldPart[i]);
  }
  const auto measured = sensor.Measure(data, placement.part, placement.Believed());
  if (!measured) return std::nullopt;
  return Between(*measured, placement.X_WorldPart[placement.part.index()]);
}

bool KeepsPromise(const domain::SensorModel& promise, const Displacement& error) {
  const std::array<Interval, 4> bounds = {promise.x, promise.y, promise.z, promise.theta};
  for (int i = 0; i < 4; ++i) {
    if (error[i] < bounds[i].low || error[i] > bounds[i].high) return false;
  }
  return true;
}

}  // namespace assay::sense
