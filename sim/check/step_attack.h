#pragma once

#include <optional>
#include <vector>

#include "sim/check/claim.h"
#include "sim/check/noisy_trial.h"
#include "sim/exec/step_execution.h"

namespace assay::check {

// A world in which a plan is executed, and what is wrong in all of it: clearance and frictions.
struct AttackedWorld {
  scene::Scene scene;
  scene::Scene finer;  // with half the timestep
  noise::Noise noise;  // the box of the whole plan; values of what is drawn later are 0
  std::vector<geometry::Pose> resting;  // exec::RestingPoses
};

// A trial on its way, saved where the tool is poised for a step.
struct PoisedTrial {
  const AttackedWorld* world = nullptr;
  noise::Noise noise;  // up to here
  exec::Checkpoint checkpoint;
};

// What became of the way to where the tool is poised for a step: the trial there, or why it does
// not come there.
struct Approach {
  std::optional<PoisedTrial> poised;
  std::vector<Claim> claims;  // of this step, that failed on the way
};

// What became of one step.
struct StepAttempt {
  noise::Noise noise;         // up to its end
  std::vector<Claim> claims;  // of this step
  // The state after it, if it came to its end and all that it was claimed on still holds.
  std::optional<exec::Checkpoint> end;
};

// Attempts one step of a plan again and again, from saved states, with other errors each time.
class StepAttack {
 public:
  StepAttack(const Experiment& experiment, plan::StepId step, const noise::Noise& noise);

  // The channels that first matter in this step: its own, and those of parts that no step before
  // has touched or looked at. Indices in the box.
  const std::vector<std::size_t>& free_channels() const { return free_; }

  // The start of a trial, or a trial at the end of the step before, on to where this step is
  // poised.
  Approach Poise(const AttackedWorld& world, const noise::Noise& noise,
                 const exec::Checkpoint* from) const;
  // `values`: of the free channels.
  StepAttempt Attempt(const PoisedTrial& poised, const std::vector<double>& values) const;

 private:
  Approach PoiseIn(const scene::Scene& scene, const AttackedWorld& world, const noise::Noise& noise,
                   const exec::Checkpoint* from) const;
  StepAttempt AttemptIn(const scene::Scene& scene, const PoisedTrial& poised,
                        const noise::Noise& noise) const;

  const Experiment& experiment_;
  plan::StepId step_;
  std::vector<domain::PartId> untouched_;
  std::vector<std::size_t> free_;
};

// Worlds at the corners of the tolerances; one world if there are none.
std::vector<AttackedWorld> WorldsOf(const Experiment& experiment,
                                    const std::vector<noise::Channel>& box);

}  // namespace assay::check
