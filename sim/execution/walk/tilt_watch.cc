#include "sim/execution/walk/tilt_watch.h"

#include <algorithm>
#include <cmath>

namespace assay::execution {

using domain::PartId;
using geometry::Vector3;

TiltWatch::TiltWatch(const scene::Scene& scene, const mujoco::Data& start) : scene_(scene) {
  for (int i = 0; i < scene.part_count(); ++i) {
    up_.emplace_back(scene.TruePose(start, PartId(i)).linear().row(2));
  }
  greatest_.assign(up_.size(), 0);
}

double TiltWatch::Tilt(const mujoco::Data& data, std::size_t part) const {
  const Vector3 up = scene_.TruePose(data, PartId(part)).linear() * up_[part];
  return std::atan2(up.head<2>().norm(), up.z());
}

void TiltWatch::Look(const mujoco::Data& data) {
  for (std::size_t i = 0; i < up_.size(); ++i) {
    greatest_[i] = std::max(greatest_[i], Tilt(data, i));
  }
}

}  // namespace assay::execution
