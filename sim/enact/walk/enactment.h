#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/enact/walk/interpretation.h"
#include "sim/enact/walk/knowledge_scenario.h"
#include "sim/enact/walk/leaves.h"
#include "sim/enact/walk/tree_walk.h"

namespace assay::enact {

// What became of a trial: of what went wrong, the first of these.
enum class EnactmentOutcome {
  kReached,     // a leaf, with the goal true in physics, nothing spilled, nothing claimed falsely
  kFalseClaim,  // what was claimed to be known was not so, even if the goal is true
  kStopped,     // a skill could not be done
  kOperator,    // a person was called
  kUncertain,   // sensing left a branch open
  kEndless,     // the walk came to no leaf
  kCollided,    // an arm touched something, a hand what it does not handle, a held part anything
  kSpilled,     // a part was tilted further than it may be
  kFallen,      // at the end a part does not rest as it did at the start
  kMissed,      // the goal is not true
};
std::string_view Name(EnactmentOutcome outcome);  // "false-claim"

// A trial's number, by which its errors are drawn, and what is hidden in it.
struct TrialWorld {
  int number = 0;  // from 1
  HiddenWorld world;
};

// The end of a step, for pictures.
struct StepPicture {
  std::string action;  // empty: the start
  const scene::Scene& scene;
  const mujoco::Data& data;
};

struct TrialSettings {
  std::uint64_t seed = 1;
  double sensing_errors = 0;                                 // WalkOptions::sensing_errors
  std::function<void(const StepPicture&)> on_step_end = {};  // and of the start
};

struct EnactedTrial {
  int number = 0;
  HiddenWorld world;
  EnactmentOutcome outcome = EnactmentOutcome::kReached;
  std::string reason = {};  // of another outcome
  Walk walk = {};
  bool is_goal_true = false;
  double greatest_tilt = 0;  // of parts that can spill, radians
  std::string fault = {};    // of the world, in words
  std::vector<std::string> spilled = {};
  std::vector<std::string> fallen = {};
  std::vector<exec::CollisionRecord> collisions = {};  // in the order of time
  double duration = 0;                                 // seconds of simulated time

  // Neither reached nor, in a world whose fault leads there, handed over to a person.
  bool IsFailed() const;
};

// Walks the tree in this world, in a simulation with errors drawn from the seed and the trial's
// number alone: where the parts are (`error` of the scenario's parts), where the hand goes
// (`error` of its gripper, anew for each action), what the sensors read. Safe to call from many
// threads.
EnactedTrial RunTrial(const KnowledgeScenario& scenario, const contingent::PlanTree& tree,
                      const TrialWorld& trial, const TrialSettings& settings);

}  // namespace assay::enact
