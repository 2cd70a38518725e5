#pragma once

#include "sim/exec/control/hybrid_control.h"

namespace assay::exec {

// One mating alone, without what leads to it.
struct MatingSetting {
  domain::MatingId mating;
  plan::Hold hold;              // of the held part
  Pose X_HeldTip;               // plan::Strategy::X_HeldTip
  Vector3 d = Vector3::Zero();  // how the held part is displaced in the hand, seen by the mated
  Vector3 w = Vector3::Zero();  // tip: metres, and radians about its origin, fixed part's axes
  // The arm starts in the configuration that is nearest to these joint values; none: to its home.
  std::optional<JointVector> near = {};
};

struct MatingTrialOptions {
  ControlLaw law = {};
  MotionObserver observer = {};
};

struct MatingResult {
  StrategyEnd end;
  double duration = 0;        // simulated seconds
  double greatest_force = 0;  // newtons at the wrist
  Pose X_FixedHeld;           // truly, at the end
};

// Whether a trial of the strategy can begin: the arm gets to where it then truly starts, and the
// held part is clear of the fixed one there. Else the errors are of no possible trial.
bool CanStart(const domain::Problem& problem, const MatingSetting& setting,
              const plan::Strategy& strategy);

// The fixed part lies clamped where it is believed to be, the hand holds the other one, and the arm
// is where it believes the strategy to start. That the part is displaced in the hand is told as an
// error of the hand (Execution::SetHandError): pads that a part does not lie flat on would put it
// right, and to the arm it is all the same. Only for what CanStart.
MatingResult RunMatingTrial(const domain::Problem& problem, const scene::Scene& scene,
                            const MatingSetting& setting, const plan::Strategy& strategy,
                            const MatingTrialOptions& options = {});

// The same mating by one guarded straight line, as the executor does it without a strategy. Done:
// it met resistance within a millimetre of its end.
MatingResult RunStraightMating(const domain::Problem& problem, const scene::Scene& scene,
                               const MatingSetting& setting,
                               const MatingTrialOptions& options = {});

}  // namespace assay::exec
