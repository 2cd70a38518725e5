#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "planner/domain/workcell/model_path.h"
#include "sim/enact/walk/enactment.h"

namespace assay::cli {

// Trials of one plan tree.
struct EnactmentStudy {
  std::string scenario;      // path, as the user gave it
  domain::ModelPath models;  // as the user gave them
  std::uint64_t seed = 0;
  double sensing_errors = 0;
  bool is_every_leaf = false;  // the trials go through the leaves in turn
  bool can_spill = false;      // something in the scenario
  std::vector<enact::Leaf> leaves;
  // Of each leaf, if they are gone through: why no world leads there; empty: one may.
  std::vector<std::string> unreachable = {};
  std::vector<enact::EnactedTrial> trials = {};
  double seconds = 0;
  std::map<std::string, std::string> words = {};  // of actions, where the tree has none for people

  int Failed() const;
};

// A row for each leaf of the tree, then the trials that failed, then totals.
std::string TextOf(const EnactmentStudy& study);
nlohmann::ordered_json ToJson(const EnactmentStudy& study);  // enact.schema.json

}  // namespace assay::cli
