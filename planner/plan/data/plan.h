#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "planner/base/id.h"
#include "planner/base/outcome.h"
#include "planner/domain/mating/mating.h"
#include "planner/domain/workcell/uncertainty_operations.h"
#include "planner/geometry/pose.h"
#include "planner/kinematics/arm.h"
#include "planner/plan/data/certificate.h"
#include "planner/plan/data/strategy.h"

namespace assay::plan {

using domain::MatingId;
using domain::PartId;
using geometry::Pose;

// How the hand holds a part. Complete in itself: who executes a plan need not compute grasps.
struct Hold {
  std::string grasp;  // label, for people
  Pose X_PartTool;
  double width = 0;  // metres between the pads

  bool operator==(const Hold& other) const {  // to the last bit
    return grasp == other.grasp && X_PartTool.matrix() == other.X_PartTool.matrix() &&
           width == other.width;
  }
};

// Where a part rests.
struct Place {
  std::string position;  // label of its stable pose, or "initial"
  Pose X_WorldPart;

  bool operator==(const Place& other) const {  // to the last bit
    return position == other.position && X_WorldPart.matrix() == other.X_WorldPart.matrix();
  }
};

struct Pickup {
  PartId part;
  Hold hold;
  Place from;

  bool operator==(const Pickup&) const = default;
};

struct Putdown {
  PartId part;
  Hold hold;
  Place to;

  bool operator==(const Putdown&) const = default;
};

struct Assemble {
  MatingId mating;
  Hold hold;    // of the held part
  Place fixed;  // of the fixed part

  bool operator==(const Assemble&) const = default;
};

// A sensor of the workcell looks at a part that lies free: what is believed of the part's pose is
// then as good as the sensor.
struct Sense {
  PartId part;
  std::string sensor;
  Place at;

  bool operator==(const Sense&) const = default;
};

// The pads close on a part and open again, to bring it to where the hand is: the manipulation that
// reduces uncertainty (Spar, "Satisfying Uncertainty-Reduction Goals").
struct Squeeze {
  PartId part;
  Hold hold;
  Place at;

  bool operator==(const Squeeze&) const = default;
};

using Action = std::variant<Pickup, Putdown, Assemble, Sense, Squeeze>;

// How the arm comes to where it is poised before its work: by the usual way (straight up, over at
// safe height, straight down), or, where that is not free, by another. Also in which of the
// postures that bring the tool there.
struct Travel {
  // Straight in joint space from each to the next: from where the step before leaves the tool after
  // its retreat (plan::RouteOf) to where this one is poised; of the usual way what is between the
  // straight lines. At least two, radians.
  std::vector<kinematics::JointVector> path;
  // What bodies keep from each other all along, wherever the parts are within their errors, metres;
  // hand and held part may be as near to parts and table as they are at an end of the path.
  double clearance = 0;
  bool is_usual = false;
};

struct PlannedStep {
  std::string name;  // "action_3"
  Action action;
  int inserted = 0;  // position in the order in which the planner added the steps, from 1
  int executed = 0;  // position in the order of execution, from 1
  Certificate certificate = {};
  std::optional<Strategy> strategy =
      {};                             // of assemble: how fine motion executes it; none: straight
  std::optional<Travel> travel = {};  // none: the usual way, in any posture
};

// A check after a step whose preconditions could not be proved: a measured quantity against what it
// is when the step went well (Spar, figure 11).
struct Verification {
  StepId step;  // that it follows
  std::string name;
  domain::MeasuredQuantity quantity;
  double expected = 0;   // metres
  double tolerance = 0;  // metres, on both sides
  std::string below;     // error signalled if less than expected - tolerance; empty: none
  std::string above;     // likewise if more
};

// What is done when a verification signals an error (Spar, figure 12).
struct Recovery {
  StepId step;  // whose failure it mends
  std::string error;
  domain::RecoveryStrategy strategy;
  double radius = 0;  // metres, of a groping search
  double pitch = 0;   // metres, between its tries
};

// A plan instance: every plan variable has its value (Spar, "Representation of Plans"); with the
// error count, the verifications and the recoveries an augmented plan instance.
struct Plan {
  std::string problem;                                   // name of the scenario
  std::vector<PlannedStep> steps = {};                   // in the order of insertion
  std::vector<std::pair<StepId, StepId>> ordering = {};  // first before second; the order of
                                                         // execution is one of its linearizations,
                                                         // and every other one works too
  std::vector<Verification> verifications = {};
  std::vector<Recovery> recoveries = {};
  int errors = 0;  // actions whose uncertainty-reduction goals are not met (Spar's error count)
  std::optional<Travel> homing = {};  // after the last step, to the arm's home; none: the usual way

  const PlannedStep& step(StepId id) const { return steps[id.index()]; }
  std::vector<StepId> ExecutionOrder() const;
};

// What a planner answers. `conflict` is there if and only if the outcome is kNone: constraints in
// the scenario's words that cannot hold together, none of which can be left out; never empty.
struct PlanResult {
  Outcome outcome = Outcome::kBudget;
  Plan plan;
  std::vector<std::string> conflict;
  std::map<std::string, std::int64_t> counters;  // machine-free: nodes, instances, ...
  // What was in the way of the first plan instance, if the arm could execute none: a sentence. With
  // kBudget: no path was found, which is no proof that there is none.
  std::string obstruction = {};
  // At kNone: what "no plan exists" is said of (robots, actions, grasps, places), one sentence
  // each.
  std::vector<std::string> hypotheses = {};
  // At kNone: by how much constraints of the conflict fail at least.
  std::vector<std::string> near_misses = {};
  // At kBudget: what the planner does not do, and a plan may need.
  std::vector<std::string> limits = {};
};

}  // namespace assay::plan
