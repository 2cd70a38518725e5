#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "planner/plan/data/plan.h"
#include "sim/exec/control/mating_outcome.h"
#include "sim/exec/execution/world_model.h"
#include "sim/scene/scene.h"

namespace assay::exec {

// Where something is in the simulation, and where it is believed to be; world frame.
struct TrueAndBelieved {
  Pose truth;
  Pose believed;
};

// The world at one time.
struct Moment {
  double time = 0;  // simulated seconds since the start
  TrueAndBelieved tool;
  std::vector<TrueAndBelieved> parts = {};  // by PartId
  std::vector<double> table_heights = {};   // under each, metres; believed to be 0
  double opening = 0;                       // metres between the pads
  scene::Wrench wrist;                      // Scene::WristWrench
  // Names of bodies that touch, each pair once, in alphabetical order.
  std::vector<std::pair<std::string, std::string>> contacts = {};
};

// One of the series of moments at equal times.
struct Sample {
  Moment moment;
};

// What closing the gripper came to. A grasp that fails is a fact like others: the executor goes on.
struct GraspFact {
  double time = 0;
  PartId part;
  double expected_width = 0;  // metres
  double opening = 0;         // metres, after closing
  bool pads_touch = false;    // both of them the part
  bool holds() const;         // they do, and the opening is the width to kGraspTolerance
};
inline constexpr double kGraspTolerance = 0.001;  // metres

// What a sensor told of a part, world frame.
struct LookRecord {
  double time = 0;
  PartId part;
  std::string sensor;
  bool found = true;
  Pose measured;  // if found
  TrueAndBelieved before;
  Pose believed;  // afterwards
};

// How a guarded move ended.
struct GuardRecord {
  double time = 0;
  bool resisted = false;  // before its end
  Pose tool;              // where the hand believes itself to be
};

// An unwanted contact of a strategy (plan::UnwantedContact) that was made, or lost, by what is
// felt.
struct RecognizedContact {
  std::string name;  // "vertex 8 on face 6"
  bool is_loss = false;
  double time = 0;  // at which it was felt
};

// How a motion of a strategy ended.
struct MotionRecord {
  double time = 0;
  plan::StepId step;
  int motion = 0;   // index
  int attempt = 1;  // at the strategy, from 1
  MatingOutcome outcome = MatingOutcome::kDone;
  // None: no error state, or none that the plan knows. Done all the same: it was the last attempt.
  std::optional<RecognizedContact> recognized = {};
};

// What is reached in a step.
enum class Stage {
  kPoised,   // the tool is before or above its work
  kReached,  // it is where it acts: the pads beside the part, the held part down or seated
  kActed,    // the pads are closed, the sensor has looked
};
std::string_view Name(Stage stage);  // "poised"

struct Milestone {
  plan::StepId step;
  Stage stage;
  Moment moment;
};

// What a verification measured (Spar, figure 11).
struct VerificationRecord {
  double time = 0;
  plan::StepId step;
  std::string name;
  double measured = 0;  // metres
  double expected = 0;
  double tolerance = 0;
  std::string error;  // signalled; empty: none
};

// What was done about an error (Spar, figure 12).
struct RecoveryRecord {
  double time = 0;
  plan::StepId step;
  std::string error;
  domain::RecoveryStrategy strategy;
  int attempt = 0;                   // from 1; of a call of the operator 0
  Vector3 offset = Vector3::Zero();  // of where it is tried, world frame, metres
};

// The end point of a step (Spar, figure 17).
struct StepEnd {
  plan::StepId step;
  std::string name;    // "action_3"
  std::string action;  // "putdown(block, on-back)"
  Moment moment;
};

// How still each part was in the last half second, after the last command.
struct RestRecord {
  double duration = 0;  // seconds
  struct Speeds {
    double linear = 0;   // the greatest, m/s
    double angular = 0;  // rad/s
  };
  std::vector<Speeds> parts = {};  // by PartId
};

// A robot touched what it was not to touch (CollisionWatch): names of bodies, each pair once.
struct CollisionRecord {
  double time = 0;
  std::string robot;  // "arm/forearm"; "part/can1", which it holds
  std::string other;  // "part/brick"
};

// How the execution of a plan ended.
enum class ExecutionOutcome {
  kDone,            // every command was executed; what came of it, the checks tell
  kUnreachable,     // the arm cannot go a way that a command wants
  kOverload,        // the wrist felt more force than it may: protective stop
  kEngineWarning,   // the engine's numbers cannot be trusted
  kNotFound,        // a sensor did not see the part that it was to look at
  kOperatorCalled,  // an error was signalled, and no recovery mended it
};
std::string_view Name(ExecutionOutcome outcome);

struct ExecutionEnd {
  ExecutionOutcome outcome = ExecutionOutcome::kDone;
  std::string reason = {};  // empty if done
  Moment moment;
  std::int64_t steps = 0;  // of the engine
};

using TraceEvent = std::variant<Sample, GraspFact, LookRecord, GuardRecord, MotionRecord, Milestone,
                                VerificationRecord, RecoveryRecord, StepEnd, RestRecord,
                                CollisionRecord, ExecutionEnd>;

// All that is recorded about one execution, in the order of time.
struct Trace {
  std::string problem;
  std::vector<std::string> parts = {};  // names, by PartId
  std::vector<TraceEvent> events = {};

  template <class Event>
  std::vector<const Event*> All() const {
    std::vector<const Event*> found;
    for (const TraceEvent& event : events) {
      if (const auto* e = std::get_if<Event>(&event)) found.push_back(e);
    }
    return found;
  }
  const ExecutionEnd& end() const { return std::get<ExecutionEnd>(events.back()); }
};

// One JSON object a line (trace.schema.json): first what the trace is of, then the events. Equal
// traces give equal bytes.
void WriteTrace(const Trace& trace, std::ostream& out);

}  // namespace assay::exec
