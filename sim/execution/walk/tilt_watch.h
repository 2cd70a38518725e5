#pragma once

#include <vector>

#include "sim/scene/scene.h"

namespace assay::execution {

// Records the greatest tilt of each part, compared with its orientation at the start.
class TiltWatch {
 public:
  // Takes the orientations of the start from `start`. `scene` must outlive the watch.
  TiltWatch(const scene::Scene& scene, const mujoco::Data& start);

  // Call it after every timestep of the simulation.
  void Look(const mujoco::Data& data);
  double greatest(domain::PartId part) const { return greatest_[part.index()]; }  // radians

 private:
  double Tilt(const mujoco::Data& data, std::size_t part) const;

  const scene::Scene& scene_;
  std::vector<geometry::Vector3> up_;  // the vertical of the start, in the frame of each part
  std::vector<double> greatest_;
};

}  // namespace assay::execution
