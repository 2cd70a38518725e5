#pragma once

#include <span>
#include <vector>

#include "sim/scene/scene.h"
#include "sim/sense/fitting/edge_search.h"
#include "sim/sense/fitting/pose_fit.h"
#include "sim/sense/overhead_eyes.h"
#include "sim/sense/pose_sensor.h"

namespace assay::sense {

// The workcell's "overhead-camera" as a sensor of poses. It distinguishes the part from the table
// by colour, and returns the pose whose silhouette fits all pictures best. The part may be up to 10
// mm in x and in y, 3 mm in height and 8 degrees in yaw from its believed pose. The arm should not
// stand between the part and the eyes.
//
// A camera must be used by the thread that made it, because its renderer belongs to that thread. It
// has no memory: the same data and believed pose give the same answer, bit for bit.
class OverheadCamera : public PoseSensor {
 public:
  // Throws EnvironmentError if nothing renders on this machine. Scene and problem must outlive it.
  OverheadCamera(const scene::Scene& scene, const domain::Problem& problem);

  // Returns none if the part is not found. It also returns none if too little of the part is
  // visible, or the fit is too bad, to keep the promise of the workcell file.
  std::optional<Pose> Measure(const mujoco::Data& data, PartId part, const Pose& believed) override;

  // Return the pictures of the eyes when they look for the part, and the fit of the part's pose to
  // them. They serve calibration and tests.
  std::vector<Picture> Look(const mujoco::Data& data, PartId part, const Pose& believed);
  PoseFit Fit(std::span<const Picture> pictures, PartId part, const Pose& believed) const;

 private:
  const domain::Problem& problem_;
  Palette palette_;
  OverheadEyes eyes_;
};

}  // namespace assay::sense
