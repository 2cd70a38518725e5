#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "sim/execution/trial/tree_trial.h"
#include "sim/sweep/shell_commands/run_command.h"

namespace assay::cli {

// The trials of one plan tree.
struct TreeStudy {
  sweep::RunCommand command;  // repeats all trials
  bool can_spill = false;     // something in the scenario can spill
  std::vector<execution::Leaf> leaves;
  // One text for each leaf, if the trials go through the leaves: the reason why no world leads
  // there, or empty if a world may.
  std::vector<std::string> unreachable = {};
  std::vector<execution::TreeTrial> trials = {};
  double seconds = 0;
  // Names of actions for people, where the tree has none.
  std::map<std::string, std::string> words = {};

  int Failed() const;
};

// Returns a row for each leaf of the tree, then the trials that failed, then totals.
std::string TextOf(const TreeStudy& study);
nlohmann::ordered_json ToJson(
    const TreeStudy& study);  // by sim/cli/verbs/contingent_run.schema.json

}  // namespace assay::cli
