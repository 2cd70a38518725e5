#pragma once

#include <span>
#include <vector>

#include "sim/scene/scene.h"
#include "sim/sense/edge_search.h"
#include "sim/sense/overhead_eyes.h"
#include "sim/sense/pose_fit.h"
#include "sim/sense/pose_sensor.h"

namespace assay::sense {

// The workcell's "overhead-camera" as a sensor of poses. The part is told from the table by its
// colour, and its pose is that of which the silhouette fits all pictures best. The part may be up
// to 10 mm in x and in y, 3 mm in height and 8 degrees in yaw from where it is believed to be; the
// arm should not stand between it and the eyes.
//
// It belongs to the thread that made it, as its renderer does, and remembers nothing: the same data
// and belief give the same answer, bit for bit.
class OverheadCamera : public PoseSensor {
 public:
  // Throws EnvironmentError if nothing renders on this machine. Scene and problem must outlive it.
  OverheadCamera(const scene::Scene& scene, const domain::Problem& problem);

  // None if the part is not found, or what is seen of it is too little or fits too badly to keep
  // the promise of the workcell file.
  std::optional<Pose> Measure(const mujoco::Data& data, PartId part, const Pose& believed) override;

  // What the eyes see when they look for the part, and how well it fits: for calibration and tests.
  std::vector<Picture> Look(const mujoco::Data& data, PartId part, const Pose& believed);
  PoseFit Fit(std::span<const Picture> pictures, PartId part, const Pose& believed) const;

 private:
  const domain::Problem& problem_;
  Palette palette_;
  OverheadEyes eyes_;
};

}  // namespace assay::sense
