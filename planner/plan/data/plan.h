#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/base/id.h"
#include "planner/base/outcome.h"
#include "planner/domain/workcell/uncertainty_operations.h"
#include "planner/kinematics/arm.h"
#include "planner/plan/certificates/certificate.h"
#include "planner/plan/data/action.h"
#include "planner/plan/data/reason.h"
#include "planner/plan/data/strategy.h"

namespace assay::plan {

// The way of the arm to where it is poised before its work, and the posture in which it arrives.
// The usual way is straight up, over at safe height, and straight down. Where this is not free, the
// arm takes another way.
struct Travel {
  // Postures in radians, at least two; the arm moves straight in joint space from each to the next.
  // The path leads from where the step before leaves the tool after its retreat (plan::RouteOf) to
  // where this step is poised. For the usual way, the path is the piece between the straight lines.
  std::vector<kinematics::JointVector> path;
  // Least distance between bodies all along the path, in metres, wherever the parts are within
  // their errors. Hand and held part may be as near to parts and table as they are at an end of the
  // path.
  double clearance = 0;
  bool is_usual = false;
};

struct PlannedStep {
  std::string name;  // "action_3"
  Action action;
  int inserted = 0;  // position in the order in which the planner added the steps, from 1
  int executed = 0;  // position in the order of execution, from 1
  Certificate certificate = {};
  // The fine motion that executes a mating. If there is none, the mating is a straight motion.
  std::optional<Strategy> strategy = {};
  std::optional<Travel> travel = {};  // none: the usual way, in any posture
};

// A check after a step whose preconditions could not be proved. It compares a measured quantity
// with its value after a step that went well (Spar, figure 11).
struct Verification {
  StepId step;  // the step that it follows
  std::string name;
  domain::MeasuredQuantity quantity;
  double expected = 0;   // metres
  double tolerance = 0;  // metres, on both sides
  std::string below;     // error signalled if less than expected - tolerance; empty: none
  std::string above;     // error signalled if more than expected + tolerance; empty: none
};

// The reaction to an error that a verification signals (Spar, figure 12).
struct Recovery {
  StepId step;  // step whose failure it recovers from
  std::string error;
  domain::RecoveryStrategy strategy;
  double radius = 0;  // radius of a groping search, metres
  double pitch = 0;   // distance between tries of a groping search, metres
};

// A plan instance: every plan variable has its value (Spar, "Representation of Plans"). With the
// error count, the verifications and the recoveries, it is an augmented plan instance.
struct Plan {
  std::string problem;                  // name of the scenario
  std::vector<PlannedStep> steps = {};  // the steps in the order of insertion
  // Each pair is first before second. The order of execution is one of the ordering's
  // linearizations, and every other linearization works, too.
  std::vector<std::pair<StepId, StepId>> ordering = {};
  std::vector<Verification> verifications = {};
  std::vector<Recovery> recoveries = {};
  int errors = 0;  // actions whose uncertainty-reduction goals are not met (Spar's error count)
  // Travel from the last step to the arm's home; none: the usual way.
  std::optional<Travel> homing = {};
  // The file's list of effects that no precondition covers (NotCovered). None if the plan has no
  // such list.
  std::optional<std::vector<std::string>> not_covered = {};

  const PlannedStep& step(StepId id) const { return steps[id.index()]; }
  std::vector<StepId> ExecutionOrder() const;
};

// Returns whether any step has a certificate. If none has, the plan was made without regard to
// uncertainty.
bool IsCertified(const Plan& plan);

// The answer of a planner. `conflict` has entries if and only if the outcome is kNone: constraints
// in the scenario's words that cannot hold together, and none of which can be left out.
struct PlanResult {
  Outcome outcome = Outcome::kBudget;
  Plan plan;
  std::vector<Reason> conflict;
  // Independent of the machine: nodes, instances, ...
  std::map<std::string, std::int64_t> counters;
  // If the arm could execute no plan instance, this is the obstruction of the first one. If the
  // outcome is kBudget, no path was found, which does not prove that there is none.
  std::optional<Reason> obstruction = {};
  // If the outcome is kNone: the robots, actions, grasps and places for which it was proved that no
  // plan exists, one sentence each.
  std::vector<std::string> hypotheses = {};
  // If the outcome is kNone: the least amounts by which constraints of the conflict fail.
  std::vector<Reason> near_misses = {};
  // If the outcome is kBudget: abilities that a plan may need and the planner does not have.
  std::vector<std::string> limits = {};
};

}  // namespace assay::plan
