#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/check/trial/noisy_trial.h"

namespace assay::check {

// One channel of a trial's noise: what was drawn, what the engine or the executor was given for it
// (applied), and what came of it on the bodies (measured).
//
// - Place and yaw of a part. Applied: its pose in the engine at the start, from the one that the
//   problem says. Measured: its true pose when the first step is poised, from where it rests
//   without errors.
// - Height of a table. Applied: of its geom, when the first step is poised, or the step in which
//   something is put down there. Measured: of the part's origin, at that time, or at the end of the
//   step, from what it is without errors.
// - Hand. Applied: the pose by which the noise tells the executor to err in this step; what the
//   executor made of it is in no trace. Measured: the true tool in the frame of the believed one,
//   when the step is poised.
// - Sensor. Applied: the true pose from the one that was told. Measured: from the one that is
//   believed when the step has acted.
// - Clearance. Applied: how far the hole's wall is set back in the compiled model. Measured: how
//   much farther the held part can be moved until it touches.
// - Frictions. Applied: of a geom in the compiled model. Measured: of a contact.
//
// None: the trial did not come that far, what was told is not what is believed (the planner knew it
// better), or there is nothing that it could be read from.
struct LedgerEntry {
  noise::Channel channel;
  std::string unit;  // "m" or "rad"; of frictions empty
  double drawn = 0;
  std::optional<double> applied = {};
  std::optional<double> measured = {};
};

// All channels of the noise, in their order. `trace` is of a trial with that noise. The world as it
// was at the start of the trial is made once more.
std::vector<LedgerEntry> LedgerOf(const Experiment& experiment, const noise::Noise& noise,
                                  const exec::Trace& trace);

}  // namespace assay::check
