#pragma once

#include <string>
#include <vector>

#include "planner/base/id.h"
#include "sim/sense/color_filter.h"
#include "sim/sense/overhead_eyes.h"

namespace assay::sense {

using ColorId = Id<struct ColorTag>;

struct NamedColor {
  std::string name;
  Color color;
};

// The workcell's "overhead-camera" as a sensor of colours. Its four cameras (OverheadEyes) look at
// the believed pose of a part. For each colour the sensor computes the share of the part's pixels
// that pass the colour's filter, over the pictures of all four cameras together.
//
// Its promise holds for a part that has one of the colours and is within the search window, with
// lamps of 0.5 to 1.5 times the scene's brightness. The sensor then returns the part's colour or
// none, never another colour. It returns none if no colour has a clear majority, for example
// because an arm is in the way or the part is elsewhere.
//
// A sensor must be used by the thread that made it. It keeps no memory of earlier measurements.
class ColorSensor {
 public:
  // The colours must have hues, and no pixel may pass two of them (checked). Throws
  // EnvironmentError if nothing renders on this machine. Scene and problem must outlive it.
  ColorSensor(const scene::Scene& scene, const domain::Problem& problem,
              const std::vector<NamedColor>& colors);

  // Returns the colour of the part; None if no colour has a clear majority.
  ColorId Measure(const mujoco::Data& data, PartId part, const Pose& believed);

  // Returns the share of each colour among the pixels at the part's believed pose.
  std::vector<double> Shares(const mujoco::Data& data, PartId part, const Pose& believed);

  static constexpr SearchWindow kWindow = {.distance = 0.010, .yaw = 0.15, .height = 0.003};
  static constexpr double kLeastShare = 0.5;   // the least share of the returned colour
  static constexpr double kOthersShare = 0.1;  // the greatest share of all others together

 private:
  const domain::Problem& problem_;
  OverheadEyes eyes_;
  std::vector<ColorFilter> filters_;
};

}  // namespace assay::sense
