#pragma once

#include <fmt/format.h>

#include <vector>

#include "sim/execution/commands/command.h"
#include "sim/noise/noise.h"

namespace assay::execution {

// Returns noise with a single error of this value, in metres or radians.
inline noise::Noise Only(noise::Effect effect, double value, PartId part = PartId::None(),
                         plan::StepId step = plan::StepId::None()) {
  const noise::Channel channel = {
      .name = "only", .effect = effect, .part = part, .step = step, .range = {-1, 1}};
  return {{channel}, {value}};
}

// Returns noise with four errors of the hand in a step, or of a sensor: x, y, z in metres and yaw
// in radians. `first` is the effect of x.
inline noise::Noise FourErrors(noise::Effect first, plan::StepId step,
                               const std::vector<double>& values) {
  std::vector<noise::Channel> box;
  for (int i = 0; i < 4; ++i) {
    box.push_back({.name = fmt::format("error{}", i),
                   .effect = static_cast<noise::Effect>(static_cast<int>(first) + i),
                   .step = step,
                   .range = {-1, 1}});
  }
  return {box, values};
}

}  // namespace assay::execution
