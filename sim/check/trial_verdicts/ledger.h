#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/check/trial_verdicts/trial.h"

namespace assay::check {

// One channel of a trial's noise, with three values. `drawn` was drawn from the error box.
// `applied` is what the engine or the executor was given for it. `measured` is the resulting error
// of the bodies. A tool is poised for a step when it has reached the pose before or above its work.
// The values mean for each kind of channel:
//
// - Place and yaw of a part. Applied: the part's pose in the engine at the start, relative to the
//   pose in the problem. Measured: the part's true pose when the tool is poised for the first step,
//   relative to where the part rests without errors.
// - Height of a table. Applied: the height of its geom when the tool is poised for the first step,
//   or for the step that puts a part down on this table. Measured: the height of the part's origin
//   when the tool is poised for the first step, or at the end of the step that puts the part down,
//   relative to its height without errors.
// - Hand. Applied: the pose error that the noise gives the executor for this step. No trace
//   contains the pose that the executor computed from it. Measured: the true tool in the believed
//   tool's frame, when the tool is poised for the step.
// - Sensor. Applied: the true pose relative to the measured pose. Measured: the true pose relative
//   to the believed pose after the step has acted.
// - Clearance. Applied: how far the hole's wall is set back in the compiled model. Measured: how
//   much farther the held part can be moved until it touches the wall.
// - Frictions. Applied: the friction of a geom in the compiled model. Measured: the friction of a
//   contact.
//
// A value is missing in three cases: the trial ended before it could be read, the executor did not
// take the sensor's value because it knew the coordinate better, or the world has nothing to read
// it from.
struct LedgerEntry {
  noise::Channel channel;
  double drawn = 0;
  std::optional<double> applied = {};
  std::optional<double> measured = {};
};

// Returns one entry for each channel of the noise, in the order of the channels. `trace` must come
// from a trial with this noise. The trial's world at its start is built again to read values from
// it.
std::vector<LedgerEntry> LedgerOf(const Experiment& experiment, const noise::Noise& noise,
                                  const execution::Trace& trace);

}  // namespace assay::check
