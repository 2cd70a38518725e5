#include "sim/render/sight.h"

#include <mujoco/mujoco.h>

#include <algorithm>

namespace assay::render {
namespace {

constexpr double kOnSurface = 1e-4;  // metres from a point that are ignored

// Returns whether the renderer draws the geom. It leaves out hidden groups and transparent geoms.
bool IsDrawn(const mjModel& model, int geom) {
  mjvOption shown;
  mjv_defaultOption(&shown);
  return shown.geomgroup[model.geom_group[geom]] != 0 && model.geom_rgba[4 * geom + 3] > 0;
}

// Returns the distance from `from` at which the ray meets the geom, in lengths of `ray`; negative
// if it does not meet the geom.
double Meets(const mujoco::Data& data, int geom, const Vector3& from, const Vector3& ray) {
  const mjModel& model = *data.model().get();
  const mjData& engine = *data.get();
  if (model.geom_type[geom] == mjGEOM_MESH) {
    return mj_rayMesh(&model, &engine, geom, from.data(), ray.data());
  }
  return mju_rayGeom(engine.geom_xpos + 3 * geom, engine.geom_xmat + 9 * geom,
                     model.geom_size + 3 * geom, from.data(), ray.data(), model.geom_type[geom]);
}

}  // namespace

Sight::Sight(const mujoco::Data& data, const std::vector<mujoco::BodyId>& moving) : data_(data) {
  const mjModel& model = *data.model().get();
  for (int geom = 0; geom < model.ngeom; ++geom) {
    if (!IsDrawn(model, geom)) continue;
    const int root = model.body_rootid[model.geom_bodyid[geom]];
    const bool moves = std::ranges::any_of(
        moving, [&](mujoco::BodyId body) { return model.body_rootid[body.index()] == root; });
    shapes_.push_back({mujoco::GeomId(geom), moves});
  }
}

bool Sight::Sees(const Vector3& eye, const Vector3& point, const Vector3& moved) const {
  const Vector3 from = point + kOnSurface * (eye - point).normalized();
  const Vector3 ray = eye - from;
  return std::ranges::none_of(shapes_, [&](const Shape& shape) {
    const Vector3 seen_from = shape.moves ? Vector3(from - moved) : from;
    const double at = Meets(data_, shape.geom.index(), seen_from, ray);
    return at >= 0 && at <= 1;
  });
}

}  // namespace assay::render
