#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "planner/domain/workcell/model_path.h"
#include "sim/execution/trial/enactment.h"

namespace assay::cli {

// The trials of one plan tree.
struct EnactmentStudy {
  std::string scenario;       // path, as the user gave it
  domain::ModelPath models;   // as the user gave them
  bool is_asked_for = false;  // the tree was asked for with --tree
  std::uint64_t seed = 0;
  double sensing_errors = 0;
  bool is_every_leaf = false;  // the trials go through the leaves in turn
  bool can_spill = false;      // something in the scenario can spill
  std::vector<execution::Leaf> leaves;
  // One text for each leaf, if the trials go through the leaves: the reason why no world leads
  // there, or empty if a world may.
  std::vector<std::string> unreachable = {};
  std::vector<execution::EnactedTrial> trials = {};
  double seconds = 0;
  // Names of actions for people, where the tree has none.
  std::map<std::string, std::string> words = {};

  int Failed() const;
};

// Returns a row for each leaf of the tree, then the trials that failed, then totals.
std::string TextOf(const EnactmentStudy& study);
nlohmann::ordered_json ToJson(
    const EnactmentStudy& study);  // by sim/cli/verbs/contingent_run.schema.json

}  // namespace assay::cli
