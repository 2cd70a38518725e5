#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "sim/cli/program/exit_code.h"
#include "sim/cli/work/planned_problem.h"
#include "sim/noise/sampling.h"

namespace assay::cli {

// Executions of one plan under noise, each certificate held against what truly happened.
struct NoisyRun {
  const PlannedProblem& planned;
  std::string command;           // "assay run FILE ...", that makes the same plan
  std::filesystem::path folder;  // empty: nothing is written
  noise::Mode mode = noise::Mode::kUniform;
  std::optional<std::string> errors = {};  // the noise of the only trial, as noise::Text writes it
  bool camera = false;                     // looks are taken by the camera, not drawn
  int trials = 1;
  int jobs = 1;                  // threads
  std::optional<int> only = {};  // the number of the one trial that is run
  std::uint64_t seed = 0;
  bool json = false;
};

ExitCode RunNoisy(const NoisyRun& run);

// The errors of a command line (noise::Text) for this plan. Throws UsageError.
noise::Noise NoiseFrom(const std::string& errors, const PlannedProblem& planned);

// The same plan attacked (check/attack.h).
struct AttackRun {
  const PlannedProblem& planned;
  std::string command;
  std::filesystem::path folder;
  std::int64_t attempts = 1000;
  int jobs = 1;
  std::uint64_t seed = 0;
  bool conservatism = false;  // how much more noise than is guaranteed it takes to break the plan
  bool json = false;
};

ExitCode RunAttack(const AttackRun& run);

}  // namespace assay::cli
