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

// The workcell's "overhead-camera" as a sensor of colours: the eyes look at where a part is
// believed to be, and of the pixels that show it there, the share that passes each colour's filter
// is counted, over all eyes together.
//
// Its promise: of a part that has one of the colours and is within the search window, it tells that
// colour or none, never another, in light of half to one and a half times what the scene has. What
// does not show a clear majority of one colour (an arm is in the way, the part is not there) it
// does not tell.
//
// It belongs to the thread that made it and remembers nothing.
class ColorSensor {
 public:
  // The colours must have hues, and no pixel may pass two of them (checked). Throws
  // EnvironmentError if nothing renders on this machine. Scene and problem must outlive it.
  ColorSensor(const scene::Scene& scene, const domain::Problem& problem,
              const std::vector<NamedColor>& colors);

  // Which of the colours the part has; None if that cannot be told.
  ColorId Measure(const mujoco::Data& data, PartId part, const Pose& believed);

  // Of the pixels where the part is believed to be, the share of each colour.
  std::vector<double> Shares(const mujoco::Data& data, PartId part, const Pose& believed);

  static constexpr SearchWindow kWindow = {.distance = 0.010, .yaw = 0.15, .height = 0.003};
  static constexpr double kLeastShare = 0.5;   // of the colour that is told
  static constexpr double kOthersShare = 0.1;  // of all others together, at most

 private:
  const domain::Problem& problem_;
  OverheadEyes eyes_;
  std::vector<ColorFilter> filters_;
};

}  // namespace assay::sense
