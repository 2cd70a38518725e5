#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "sim/cli/program/exit_code.h"
#include "sim/scenario/scenario.h"

namespace assay::cli {

// `run --scatter`: trials of one scenario with its parts at other places, each planned anew.
struct ScatteredRun {
  std::filesystem::path scenario;
  domain::ModelPath models;      // as the user gave them
  std::filesystem::path folder;  // empty: nothing is written
  int trials = 1;
  int jobs = 1;                  // threads
  std::optional<int> only = {};  // the number of the one trial that is run
  std::uint64_t seed = 0;
  bool json = false;
};

// Every trial draws from its own stream, so that it comes out the same whatever else is run. A
// trial without a plan, or with one that the independent checker refuses, has failed.
ExitCode RunScattered(const ScatteredRun& run, const scenario::Scenario& scenario);

}  // namespace assay::cli
