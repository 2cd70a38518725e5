#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "planner/domain/workcell/model_path.h"
#include "sim/scene/mjcf.h"

namespace assay::sweep {

// The options of `assay run` that decide what its trials do. The program parses its options into
// this struct, and a sweep fills it in for a cell. The command that repeats a trial is printed from
// this struct.
struct RunCommand {
  std::filesystem::path input = {};  // scenario or plan file
  // The following members say what is executed.
  bool scatter = false;
  bool tree = false;
  std::string propagation = "sound";
  std::vector<std::string> resolvers = {};  // empty: the scenario's
  double error_scale = 1;
  std::optional<scene::GraspMode> grasp = {};  // none: the scenario's
  domain::ModelPath models = {};
  // What happens in the trials.
  std::string worlds = "drawn";
  double sensing_errors = 0;
  std::optional<std::string> noise = {};  // the name of a mode, or "attack"
  std::string sensing = "drawn";
  std::optional<std::string> errors = {};  // as noise::Text writes them
  std::optional<std::uint64_t> seed = {};  // none: the scenario's
  std::optional<int> trial = {};           // the only trial to run

  // Returns the command for a trial of the same plan, or for all trials if `number` is none.
  RunCommand Again(std::uint64_t seed_of_trials, std::optional<int> number) const;
  // Returns the command that executes the same plan without noise.
  RunCommand OfPlan() const;
  // Returns the command that executes the same plan once with these errors.
  RunCommand WithErrors(const std::string& errors_of_trial) const;

  // Returns the command for the shell. Options that have their default values are left out.
  std::string Text() const;
};

}  // namespace assay::sweep
