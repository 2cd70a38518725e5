#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim/cli/tasks/tree_worlds.h"
#include "sim/execution/trial/tree_trial.h"
#include "sim/python/planning.h"
#include "sim/python/traced_trial.h"

namespace assay::python {

// The plan tree of a scenario.
class TreeHandle {
 public:
  // Plans a tree for a scenario. Throws Refused if there is none, UsageError for settings that do
  // not fit the scenario's goal, and InputError.
  static std::shared_ptr<const TreeHandle> Make(const PlanSettings& settings);

  const execution::KnowledgeScenario& scenario() const { return scenario_; }
  const contingent::PlanTree& tree() const { return answer_.plan.tree; }
  const std::string& file() const { return file_; }
  // The plans of an assembly's worlds; none if the goal is about knowledge.
  const std::vector<std::shared_ptr<const PlanHandle>>& plans() const { return plans_; }

  nlohmann::ordered_json ToJson() const;  // what `assay plan --json` prints
  std::string Text() const;               // for people
  std::string Dot() const;                // for Graphviz
  // Returns the lines of the tree: how many branches are above it, kind and text of each.
  nlohmann::ordered_json Lines() const;
  // Runs the tree in all worlds that the initial knowledge allows, or in `worlds` of them if there
  // are more. The result has a text for people.
  nlohmann::ordered_json Checked(std::int64_t worlds) const;

 private:
  TreeHandle(execution::KnowledgeScenario scenario, std::string file, std::int64_t budget);

  const execution::KnowledgeScenario scenario_;
  const std::string file_;
  const std::int64_t budget_;  // of knowledge states
  const cli::ContingentAnswer answer_;
  const std::vector<std::shared_ptr<const PlanHandle>> plans_;
};

// What happens in the trials of a plan tree.
struct TreeTrialSettings {
  bool is_every_leaf = false;  // the trials go through the leaves; otherwise hidden facts are drawn
  double sensing_errors = 0;   // the probability with which an observation is made wrong
  std::optional<std::uint64_t> seed = {};  // none: the scenario's
};

// A plan tree that is executed repeatedly.
class TreeTrials {
 public:
  // Throws UsageError for wrong settings, and if no world leads to a leaf.
  TreeTrials(std::shared_ptr<const TreeHandle> tree, const TreeTrialSettings& settings);

  std::uint64_t seed() const { return seed_; }
  // Returns how many trials go through all leaves that can be reached; 1 if facts are drawn.
  int usual_count() const;
  // Executes the trials 1 to `count`. If a stop is requested, returns only the finished trials.
  // Returns what `assay run --json` prints, without times and commands. The result does not depend
  // on the number of jobs.
  nlohmann::ordered_json Run(int count, int jobs) const;
  // Executes one trial and keeps its trace. The numbers of trials count from 1.
  std::shared_ptr<const TracedTrial> Traced(int number) const;

 private:
  execution::TreeTrial One(int number, double sample_rate) const;

  const std::shared_ptr<const TreeHandle> tree_;
  const TreeTrialSettings settings_;
  const std::uint64_t seed_;
  const cli::TreeWorlds worlds_;
};

}  // namespace assay::python
