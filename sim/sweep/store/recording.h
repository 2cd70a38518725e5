#pragma once

#include <string>
#include <vector>

#include "sim/check/falsification/attack.h"
#include "sim/check/falsification/conservatism.h"
#include "sim/check/trial/noisy_trial.h"
#include "sim/sweep/store/store.h"

namespace assay::sweep {

// What is kept of a trial; its numbers in the sweep are left out.
TimedTrial Recorded(const plan::Plan& plan, const check::NoisyTrial& trial);

// What is wrong with a plan without noise, one claim a line.
std::string WrongWithoutNoise(const plan::Plan& plan, const check::Noiseless& noiseless,
                              const check::NoiseFloor& gate);

// A whole attack on a plan.
struct Attacked {
  const check::AttackResult& result;
  const std::vector<check::ConservatismRatio>& ratios;  // empty: not asked for
  // The command that runs the plan under errors: after it, "--errors '...'" is written. Empty:
  // there is none.
  std::string run_command;
  std::string replay_command;  // the one that makes the attack again
};

// What is kept of an attack, as a trial. It succeeded if no certificate was violated.
TimedTrial Recorded(const plan::Plan& plan, const Attacked& attacked);

}  // namespace assay::sweep
