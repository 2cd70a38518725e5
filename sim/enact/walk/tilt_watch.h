#pragma once

#include <vector>

#include "sim/scene/scene.h"

namespace assay::enact {

// How far parts are tilted, at every timestep of a simulation, from how they stood at the start.
class TiltWatch {
 public:
  // `scene` must outlive it.
  TiltWatch(const scene::Scene& scene, const mujoco::Data& start);

  void Look(const mujoco::Data& data);
  double greatest(domain::PartId part) const { return greatest_[part.index()]; }  // radians

 private:
  double Tilt(const mujoco::Data& data, std::size_t part) const;

  const scene::Scene& scene_;
  std::vector<geometry::Vector3> up_;  // in the frame of each part
  std::vector<double> greatest_;
};

}  // namespace assay::enact
