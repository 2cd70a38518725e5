#include "sim/view/stage.h"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/base/check.h"
#include "sim/mujoco/collision/convex_pieces.h"

namespace assay::view {
namespace {

constexpr int kFirstHiddenGroup = 3;  // shapes of this group and above serve collision alone

std::string TypeOf(int type) {
  switch (type) {
    case mjGEOM_BOX:
      return "box";
    case mjGEOM_CYLINDER:
      return "cylinder";
    case mjGEOM_SPHERE:
      return "sphere";
    case mjGEOM_PLANE:
      return "plane";
    case mjGEOM_MESH:
      return "hull";
    default:
      break;
  }
  ASSAY_CHECK(false, "a shape of type {}", type);
  return {};
}

// Returns the colour of a shape: its own or, if it has none, that of its material, as the engine
// draws it.
std::string ColorOf(const mjModel& model, int geom) {
  const float* rgba = model.geom_rgba + 4 * geom;
  const bool is_default = std::all_of(rgba, rgba + 3, [](float value) { return value == 0.5F; });
  const int material = model.geom_matid[geom];
  if (is_default && material >= 0) rgba = model.mat_rgba + 4 * material;
  const auto byte = [&](int i) {
    return static_cast<int>(std::lround(255 * std::clamp(rgba[i], 0.0F, 1.0F)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(0), byte(1), byte(2));
}

Vector3 VectorAt(const mjtNum* numbers) { return {numbers[0], numbers[1], numbers[2]}; }

Eigen::Quaterniond TurnAt(const mjtNum* numbers) {
  return {numbers[0], numbers[1], numbers[2], numbers[3]};
}

Shape ShapeOf(const mujoco::Model& compiled, int geom) {
  const mjModel& model = *compiled.get();
  Pose X_BodyShape = Pose::Identity();
  X_BodyShape.linear() = TurnAt(model.geom_quat + 4 * geom).toRotationMatrix();
  X_BodyShape.translation() = VectorAt(model.geom_pos + 3 * geom);
  Shape shape{.type = TypeOf(model.geom_type[geom]),
              .size = VectorAt(model.geom_size + 3 * geom),
              .hull = {},
              .X_BodyShape = X_BodyShape,
              .color = ColorOf(model, geom)};
  if (model.geom_type[geom] == mjGEOM_MESH) {
    shape.hull = compiled.convex_pieces()->SolidOf(geom)->hull;
  }
  return shape;
}

}  // namespace

std::vector<Body> BodiesOf(const mujoco::Model& compiled) {
  const mjModel& model = *compiled.get();
  std::vector<Body> bodies;
  for (int b = 0; b < model.nbody; ++b) {
    Body body{compiled.Name(mujoco::BodyId(b)), mujoco::BodyId(b), {}};
    for (int i = 0; i < model.body_geomnum[b]; ++i) {
      const int geom = model.body_geomadr[b] + i;
      if (model.geom_group[geom] < kFirstHiddenGroup)
        body.shapes.push_back(ShapeOf(compiled, geom));
    }
    if (!body.shapes.empty()) bodies.push_back(std::move(body));
  }
  return bodies;
}

std::vector<Camera> CamerasOf(const scene::Scene& scene) {
  const mjModel& model = *scene.model().get();
  std::vector<Camera> cameras;
  for (int c = 0; c < model.ncam; ++c) {
    const std::string name = scene.model().Name(mujoco::CameraId(c));
    if (name.find("-eye-") != std::string::npos) continue;
    const geometry::Matrix3 R = TurnAt(model.cam_quat + 4 * c).toRotationMatrix();
    cameras.push_back({name, VectorAt(model.cam_pos + 3 * c), -R.col(2), R.col(1),
                       model.cam_fovy[c] * std::numbers::pi / 180});
  }
  return cameras;
}

}  // namespace assay::view
