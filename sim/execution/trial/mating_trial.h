#pragma once

#include "sim/execution/control/hybrid_control.h"
#include "sim/execution/trace/trace.h"

namespace assay::execution {

// The setting of one mating alone, without the steps that lead to it.
struct MatingSetting {
  domain::MatingId mating;
  plan::Hold hold;  // how the hand holds the held part
  Pose X_HeldTip;   // as plan::Strategy::X_HeldTip
  // The displacement of the held part in the hand, as a displacement of its mated tip: d in metres,
  // and w in radians about the tip's origin, both in the fixed part's axes.
  Vector3 d = Vector3::Zero();
  Vector3 w = Vector3::Zero();
  // The arm starts in the configuration that is nearest to these joint values, or to its home if
  // there are none.
  std::optional<JointVector> near = {};
};

struct MatingTrialOptions {
  ControlLaw law = {};
  MotionObserver observer = {};
  // As in ExecutorOptions:
  double sample_rate = 0;
  double kinematic_step = ExecutorOptions().kinematic_step;
};

struct MatingResult {
  StrategyEnd end;
  double duration = 0;        // simulated seconds
  double greatest_force = 0;  // newtons at the wrist
  Pose X_FixedHeld;           // the true pose at the end of the trial
  Trace trace = {};           // with samples: what happened
};

// Returns whether a trial of the strategy (RunMatingTrial) can begin: the arm reaches the true
// start of the strategy, and the held part is clear of the fixed part there. If not, no trial can
// have these errors.
bool CanStart(const domain::Problem& problem, const MatingSetting& setting,
              const plan::Strategy& strategy);

// Executes a strategy in the setting. The fixed part lies clamped at its believed pose, the hand
// holds the other part, and the arm is at the pose that it believes to be the start of the
// strategy. The displacement of the part in the hand is applied as an error of the hand
// (Execution::SetHandError). If the part itself were displaced, it would not lie flat on the pads,
// and the pads would correct the displacement. The arm cannot distinguish an error of the hand from
// a displaced part. CanStart must be true.
MatingResult RunMatingTrial(const domain::Problem& problem, const scene::Scene& scene,
                            const MatingSetting& setting, const plan::Strategy& strategy,
                            const MatingTrialOptions& options = {});

// Executes the same mating by one guarded straight line, as the executor does without a strategy.
// The mating is done if the arm met resistance within a millimetre of the line's end.
MatingResult RunStraightMating(const domain::Problem& problem, const scene::Scene& scene,
                               const MatingSetting& setting,
                               const MatingTrialOptions& options = {});

}  // namespace assay::execution
