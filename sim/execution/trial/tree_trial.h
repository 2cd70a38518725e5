#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/execution/hidden_worlds/leaves.h"
#include "sim/execution/interpretation/interpretation.h"
#include "sim/execution/interpretation/knowledge_scenario.h"
#include "sim/execution/trace/trace.h"
#include "sim/execution/walk/tree_walk.h"

namespace assay::execution {

// The number of a trial, which determines its random errors, and its hidden world.
struct TrialWorld {
  int number = 0;  // from 1
  HiddenWorld world;
};

// The state of the simulation at the end of a step, for pictures.
struct StepPicture {
  std::string action;  // empty: the start
  const scene::Scene& scene;
  const mujoco::Data& data;
};

struct TrialSettings {
  std::uint64_t seed = 1;
  double sensing_errors = 0;                                 // see WalkOptions::sensing_errors
  double sample_rate = 0;                                    // see ExecutorOptions::sample_rate
  std::function<void(const StepPicture&)> on_step_end = {};  // called at the start, too
};

struct TreeTrial {
  int number = 0;
  HiddenWorld world;
  TrialOutcome outcome = TrialOutcome::kSucceeded;
  std::string reason = {};  // why the trial did not succeed
  Walk walk = {};
  bool is_goal_true = false;
  double greatest_tilt = 0;  // greatest tilt of a part that can spill, in radians
  std::string fault = {};    // of the world, in words
  std::vector<std::string> spilled = {};
  std::vector<std::string> fallen = {};
  std::vector<CollisionRecord> collisions = {};  // in the order of time
  double duration = 0;                           // seconds of simulated time
  // With samples: what happened, and the options of the scene of the trial's world.
  Trace trace = {};
  scene::SceneOptions scene = {};

  // Returns whether the trial failed. A trial succeeds if the goal is reached. In a world whose
  // fault leads to a person, it succeeds if the task is handed over to a person.
  bool IsFailed() const;
  // Returns the outcome's name in reports of trees: "reached" if the walk reached the goal.
  std::string_view OutcomeName() const;
};

// Executes the tree in the trial's world, in a simulation with random errors. The seed and the
// trial's number alone determine these errors: where the parts are (`error` of the scenario's
// parts), where the hand goes (`error` of its gripper, drawn anew for each action), and what the
// sensors read. Safe to call from many threads.
TreeTrial RunTrial(const KnowledgeScenario& scenario, const contingent::PlanTree& tree,
                   const TrialWorld& trial, const TrialSettings& settings);

}  // namespace assay::execution
