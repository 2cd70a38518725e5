#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/check/falsification/conservatism.h"
#include "sim/check/falsification/falsification.h"
#include "sim/check/trial_verdicts/trial.h"
#include "sim/sweep/database/store.h"
#include "sim/sweep/shell_commands/run_command.h"

namespace assay::sweep {

// Returns the record of a trial. Its numbers in the sweep are left out.
TimedTrial Recorded(const plan::Plan& plan, const check::Trial& trial);

// Returns what is wrong with the plan without noise, one line for each claim.
std::string WrongWithoutNoise(const plan::Plan& plan, const check::Noiseless& noiseless,
                              const check::NoiseFloor& gate);

// A whole falsification of a plan.
struct MadeFalsification {
  const check::FalsificationResult& result;
  const std::vector<check::ConservatismRatio>& ratios;  // empty if they were not measured
  std::optional<RunCommand> run_command;  // makes the same plan; none if there is no such command
  std::string replay_command;             // the command that repeats the falsification
};

// Returns the record of a falsification as a trial. The trial succeeded if no certificate was
// violated.
TimedTrial Recorded(const plan::Plan& plan, const MadeFalsification& made);

}  // namespace assay::sweep
