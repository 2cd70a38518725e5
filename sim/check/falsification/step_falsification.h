#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "sim/check/certificate_claims/claim.h"
#include "sim/check/trial_verdicts/trial.h"
#include "sim/execution/walk/step_execution.h"
#include "sim/noise/possible_start.h"

namespace assay::check {

// A world in which a plan is executed, with fixed errors of clearance and frictions.
struct TriedWorld {
  scene::Scene scene;
  scene::Scene finer;  // the scene with half the timestep
  noise::Noise noise;  // over the box of the whole plan; 0 for values that are drawn later
  std::vector<geometry::Pose> resting;  // execution::RestingPoses
};

// A trial with half the timestep all the way from the plan's start to the same step. It is executed
// when it is first asked for.
struct FinerTrial {
  std::once_flag once;
  std::optional<execution::Checkpoint> checkpoint;  // missing if the trial does not come there
};

// A trial in progress, saved where the tool is poised for a step.
struct PoisedTrial {
  const TriedWorld* world = nullptr;
  noise::Noise noise;  // the values that matter up to here
  execution::Checkpoint checkpoint;
  std::shared_ptr<FinerTrial> finer = std::make_shared<FinerTrial>();
};

// The result of bringing a trial to where the tool is poised for a step: the poised trial, or the
// claims that failed before that.
struct Approach {
  std::optional<PoisedTrial> poised;
  std::vector<Claim> claims;  // claims of this step that failed before that
};

// The stage up to which a step is attempted, in the order of time.
enum class Until { kPoised, kReached, kActed, kEnd };

// The stage and time at which a claim was decided. Nothing that was observed later changed the
// result of the claim.
struct Decision {
  Until until = Until::kEnd;
  double seconds = 0;  // simulated time since the attempt began
};

// The result of an attempt at one step.
struct StepAttempt {
  noise::Noise noise;         // the values that matter up to the step's end
  std::vector<Claim> claims;  // claims of this step
  // One entry for each claim, if the step was attempted to its end.
  std::vector<Decision> decisions = {};
  // The state after the step, if the step came to its end and all assumptions of its claims still
  // hold.
  std::optional<execution::Checkpoint> end = {};

  bool IsWhole() const { return decisions.size() == claims.size(); }
};

// Attempts one step of a plan repeatedly from saved states, with other errors each time.
class StepFalsification {
 public:
  StepFalsification(const Experiment& experiment, plan::StepId step, const noise::Noise& noise);

  // Returns the channels that first matter in this step, as indices in the box. They are the step's
  // own channels and those of parts that no earlier step has touched or looked at.
  const std::vector<std::size_t>& free_channels() const { return free_; }

  // Brings a trial to where the tool is poised for this step. The trial begins at `from`, at the
  // end of the step before, or at the start of the plan if `from` is null.
  Approach Poise(const TriedWorld& world, const noise::Noise& noise,
                 const execution::Checkpoint* from) const;
  // Attempts the step up to the stage `until`. `values` are the values of the free channels. Values
  // with which parts overlap at the start are moved back toward those of the poised trial. An
  // attempt that ends before the step does not make all claims, and some of its claims may still
  // fail later. If one of its claims is violated and the step is not fully proved, the attempt is
  // made again to the step's end, since an unproved assumption may fail there.
  StepAttempt Attempt(const PoisedTrial& poised, const std::vector<double>& values,
                      Until until) const;

 private:
  // `from` is null for the start of the plan.
  Approach PoiseIn(const scene::Scene& scene, const TriedWorld& world, const noise::Noise& noise,
                   const execution::Checkpoint* from) const;
  execution::Progress ExecuteStepsBefore(execution::Execution& execution) const;
  StepAttempt AttemptIn(const scene::Scene& scene, const TriedWorld& world,
                        const execution::Checkpoint& from, const noise::Noise& noise,
                        Until until) const;
  std::vector<Claim> FinerClaims(const PoisedTrial& poised, const noise::Noise& noise,
                                 Until until) const;
  bool IsAllProved() const;
  execution::Progress Work(execution::StepExecution& step, Until until) const;
  std::vector<Claim> ClaimsOf(const execution::Trace& trace) const;
  std::vector<Decision> DecisionsOn(const std::vector<Claim>& claims, const execution::Trace& trace,
                                    double start) const;

  const Experiment& experiment_;
  noise::PossibleStart start_;
  plan::StepId step_;
  std::vector<domain::PartId> untouched_;
  std::vector<std::size_t> free_;
};

// Returns worlds at the corners of the tolerances, or one world if there are no tolerances.
std::vector<TriedWorld> WorldsOf(const Experiment& experiment,
                                 const std::vector<noise::Channel>& box);

}  // namespace assay::check
