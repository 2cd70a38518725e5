#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "planner/base/id.h"
#include "planner/base/outcome.h"
#include "planner/domain/mating.h"
#include "planner/geometry/pose.h"

namespace assay::plan {

using domain::MatingId;
using domain::PartId;
using geometry::Pose;

using StepId = Id<struct StepTag>;  // index in Plan::steps, which is the order of insertion

// How the hand holds a part. Complete in itself: who executes a plan need not compute grasps.
struct Hold {
  std::string grasp;  // label, for people
  Pose X_PartTool;
  double width = 0;  // metres between the pads
};

// Where a part rests.
struct Place {
  std::string position;  // label of its stable pose, or "initial"
  Pose X_WorldPart;
};

struct Pickup {
  PartId part;
  Hold hold;
  Place from;
};

struct Putdown {
  PartId part;
  Hold hold;
  Place to;
};

struct Assemble {
  MatingId mating;
  Hold hold;    // of the held part
  Place fixed;  // of the fixed part
};

using Action = std::variant<Pickup, Putdown, Assemble>;

struct PlannedStep {
  std::string name;  // "action_3"
  Action action;
  int inserted = 0;  // position in the order in which the planner added the steps, from 1
  int executed = 0;  // position in the order of execution, from 1
};

// A plan instance: every plan variable has its value (Spar, "Representation of Plans").
struct Plan {
  std::string problem;                                   // name of the scenario
  std::vector<PlannedStep> steps = {};                   // in the order of insertion
  std::vector<std::pair<StepId, StepId>> ordering = {};  // first before second; the order of
                                                         // execution is one of its linearizations,
                                                         // and every other one works too
  const PlannedStep& step(StepId id) const { return steps[id.index()]; }
  std::vector<StepId> ExecutionOrder() const;
};

// What a planner answers. `conflict` is there if and only if the outcome is kNone: constraints in
// the scenario's words that cannot hold together, none of which can be left out.
struct PlanResult {
  Outcome outcome = Outcome::kBudget;
  Plan plan;
  std::vector<std::string> conflict;
  std::map<std::string, std::int64_t> counters;  // machine-free: nodes, instances, ...
};

}  // namespace assay::plan
