#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "sim/check/claims/claim.h"
#include "sim/check/trial/noisy_trial.h"
#include "sim/exec/execution/step_execution.h"

namespace assay::check {

// A world in which a plan is executed, and what is wrong in all of it: clearance and frictions.
struct AttackedWorld {
  scene::Scene scene;
  scene::Scene finer;  // with half the timestep
  noise::Noise noise;  // the box of the whole plan; values of what is drawn later are 0
  std::vector<geometry::Pose> resting;  // exec::RestingPoses
};

// The same trial with half the timestep all the way from the plan's start; executed when it is
// first asked for.
struct FinerTrial {
  std::once_flag once;
  std::optional<exec::Checkpoint> checkpoint;  // none: it does not come there
};

// A trial on its way, saved where the tool is poised for a step.
struct PoisedTrial {
  const AttackedWorld* world = nullptr;
  noise::Noise noise;  // up to here
  exec::Checkpoint checkpoint;
  std::shared_ptr<FinerTrial> finer = std::make_shared<FinerTrial>();
};

// What became of the way to where the tool is poised for a step: the trial there, or why it does
// not come there.
struct Approach {
  std::optional<PoisedTrial> poised;
  std::vector<Claim> claims;  // of this step, that failed on the way
};

// Up to where a step is attempted, in the order of time.
enum class Until { kPoised, kReached, kActed, kEnd };

// When a claim was decided: nothing that was observed later changed what it says.
struct Decision {
  Until until = Until::kEnd;
  double seconds = 0;  // simulated, from where the attempt began
};

// What became of one step.
struct StepAttempt {
  noise::Noise noise;         // up to its end
  std::vector<Claim> claims;  // of this step
  // Of each claim, if the step was attempted to its end.
  std::vector<Decision> decisions = {};
  // The state after it, if it came to its end and all that it was claimed on still holds.
  std::optional<exec::Checkpoint> end = {};

  bool IsWhole() const { return decisions.size() == claims.size(); }
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
  // `values`: of the free channels. Not all claims are made of a step that is not attempted to its
  // end, and some that are made may still fail. Where one is violated it goes on to its end, if
  // something may fail there that is not proved.
  StepAttempt Attempt(const PoisedTrial& poised, const std::vector<double>& values,
                      Until until) const;

 private:
  // `from`: null for the start of the plan.
  Approach PoiseIn(const scene::Scene& scene, const AttackedWorld& world, const noise::Noise& noise,
                   const exec::Checkpoint* from) const;
  exec::Progress ExecuteStepsBefore(exec::Execution& execution) const;
  StepAttempt AttemptIn(const scene::Scene& scene, const AttackedWorld& world,
                        const exec::Checkpoint& from, const noise::Noise& noise, Until until) const;
  std::vector<Claim> FinerClaims(const PoisedTrial& poised, const noise::Noise& noise,
                                 Until until) const;
  bool IsAllProved() const;
  exec::Progress Work(exec::StepExecution& step, Until until) const;
  std::vector<Claim> ClaimsOf(const exec::Trace& trace) const;
  std::vector<Decision> DecisionsOn(const std::vector<Claim>& claims, const exec::Trace& trace,
                                    double start) const;

  const Experiment& experiment_;
  plan::StepId step_;
  std::vector<domain::PartId> untouched_;
  std::vector<std::size_t> free_;
};

// Worlds at the corners of the tolerances; one world if there are none.
std::vector<AttackedWorld> WorldsOf(const Experiment& experiment,
                                    const std::vector<noise::Channel>& box);

}  // namespace assay::check
