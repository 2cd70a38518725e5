#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "planner/domain/workcell/model_path.h"
#include "sim/cli/pictures/film.h"
#include "sim/cli/program/exit_code.h"

namespace assay::cli {

// The options of `assay run` that concern the execution of a plan tree.
struct ContingentRun {
  std::filesystem::path scenario;  // with the key `knowledge`, or with a key `goal`
  domain::ModelPath models;
  std::filesystem::path folder;    // empty: nothing is written
  bool is_tree_asked_for = false;  // --tree was given, since the plan needs no tree
  std::optional<int> trials;       // none: one, or with every leaf one trial for each leaf
  std::optional<int> trial;        // the only trial to run
  int jobs = 1;
  std::optional<std::uint64_t> seed;
  bool is_every_leaf = false;  // the trials go through the leaves of the tree in turn
  double sensing_errors = 0;   // probability with which an observation is made wrong
  bool renders = false;
  PictureOptions pictures;
  bool json = false;
};

// Plans a tree for the scenario, executes it in the simulator and audits what it claims to know.
ExitCode RunContingent(const ContingentRun& run);

}  // namespace assay::cli
