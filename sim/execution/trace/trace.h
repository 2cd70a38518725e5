#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "planner/plan/data/plan.h"
#include "sim/execution/trial/trial_outcome.h"
#include "sim/execution/world_model/world_model.h"
#include "sim/scene/scene.h"

namespace assay::execution {

// A true pose in the simulation, and the believed pose; world frame.
struct TrueAndBelieved {
  Pose truth;
  Pose believed;
};

// The world at one time.
struct Snapshot {
  double time = 0;  // simulated seconds since the start
  TrueAndBelieved tool;
  std::vector<TrueAndBelieved> parts = {};  // by PartId
  std::vector<double> table_heights = {};   // under each part, metres; believed to be 0
  double opening = 0;                       // metres between the pads
  scene::Wrench wrist;                      // Scene::WristWrench
  // Names of bodies that touch. Each pair occurs once and is in alphabetical order.
  std::vector<std::pair<std::string, std::string>> contacts = {};
  std::vector<scene::ArmPosture> arms = {};  // by RobotId
};

// A point at which two bodies touch, world frame.
struct ContactPoint {
  std::size_t pair = 0;                // index of the bodies in Snapshot::contacts
  Vector3 position = Vector3::Zero();  // metres
  Vector3 normal = Vector3::Zero();    // unit vector from the pair's first body to its second
  Vector3 force = Vector3::Zero();     // newtons, on the second body
};

// One of a series of snapshots at equal intervals.
struct Sample {
  Snapshot snapshot;
  // The points of all contacts, in the order of their pairs. None if they are unknown: no timestep
  // of the same robot followed, or the trace was written before traces had contact points.
  std::optional<std::vector<ContactPoint>> contact_points = {};
};

// The result of closing the gripper. A failed grasp is recorded like any other, and the execution
// goes on.
struct GraspFact {
  double time = 0;
  PartId part;
  double expected_width = 0;  // metres
  double opening = 0;         // metres, after closing
  bool pads_touch = false;    // both pads touch the part
  // True if pads_touch and the opening is the expected width, to kGraspTolerance.
  bool holds() const;
};
inline constexpr double kGraspTolerance = 0.001;  // metres

// The measurement of a part by a sensor, world frame.
struct LookRecord {
  double time = 0;
  PartId part;
  std::string sensor;
  bool found = true;
  Pose measured;  // measured pose, if the part was found
  TrueAndBelieved before;
  Pose believed;  // believed pose after the look
};

// The end of a guarded move. The move ends when the component of the wrist's force along the move
// has fallen by `force` since the move began.
struct GuardRecord {
  double time = 0;
  bool resisted = false;                // whether the tool met resistance before the end of its way
  Pose tool;                            // the believed pose of the tool
  double from = 0;                      // time when the move began
  double force = 0;                     // newtons
  Vector3 direction = Vector3::Zero();  // of the move, world frame, a unit vector
};

// An unwanted contact of a strategy (plan::UnwantedContact) that forces show to be made or lost.
struct RecognizedContact {
  std::string name;  // for example "vertex 8 on face 6"
  bool is_loss = false;
  double time = 0;  // when the contact was felt
};

// The end of a motion of a strategy.
struct MotionRecord {
  double time = 0;
  plan::StepId step;
  int motion = 0;   // index of the motion in the strategy
  int attempt = 1;  // number of the attempt at the strategy, from 1
  TrialOutcome outcome = TrialOutcome::kSucceeded;
  // The contact or loss that caused the error state. Missing if there was no error state, or if the
  // plan does not know the error state. If the motion succeeded, this error state was ignored in
  // the last attempt.
  std::optional<RecognizedContact> recognized = {};
};

// The stages of a step.
enum class Stage {
  kPoised,   // the tool is before or above the place where the step acts
  kReached,  // the open pads are beside the part, or the held part is on the table or in its seat
  kActed,    // the pads are closed or open, or the sensor has looked
};
std::string_view Name(Stage stage);  // for example "poised"

struct Milestone {
  plan::StepId step;
  Stage stage;
  Snapshot snapshot;
};

// The measurement of a verification (Spar, figure 11).
struct VerificationRecord {
  double time = 0;
  plan::StepId step;
  std::string name;
  double measured = 0;  // metres
  double expected = 0;
  double tolerance = 0;
  std::string error;  // the signalled error, or empty
};

// A reaction to an error (Spar, figure 12).
struct RecoveryRecord {
  double time = 0;
  plan::StepId step;
  std::string error;
  domain::RecoveryStrategy strategy;
  int attempt = 0;                   // number of the attempt, from 1; 0 for a call of the operator
  Vector3 offset = Vector3::Zero();  // offset of the place that is tried, world frame, metres
};

// The end of a step (Spar, figure 17).
struct StepEnd {
  plan::StepId step;
  std::string name;    // for example "action_3"
  std::string action;  // for example "putdown(block, on-back)"
  Snapshot snapshot;
};

// The motion of each part in the last half second, after the last command.
struct RestRecord {
  double duration = 0;  // seconds
  struct Speeds {
    double linear = 0;   // greatest speed, m/s
    double angular = 0;  // greatest speed, rad/s
  };
  std::vector<Speeds> parts = {};  // by PartId
};

// The beginning of an execution, or of the part of it that a trace records.
struct ExecutionStart {
  Snapshot snapshot;
};

// A robot touched something that it should not (CollisionWatch). Each pair of bodies occurs once,
// by name.
struct CollisionRecord {
  double time = 0;
  std::string robot;  // for example "arm/forearm", or "part/can1" for a held part
  std::string other;  // for example "part/brick"
};

// The end of an execution of a plan, which is not judged yet.
struct ExecutionEnd {
  TrialOutcome outcome = TrialOutcome::kSucceeded;
  std::string reason = {};  // empty if every command was executed
  Snapshot snapshot;
  std::int64_t steps = 0;  // number of the engine's steps
};

using TraceEvent = std::variant<ExecutionStart, Sample, GraspFact, LookRecord, GuardRecord,
                                MotionRecord, Milestone, VerificationRecord, RecoveryRecord,
                                StepEnd, RestRecord, CollisionRecord, ExecutionEnd>;

// All records of one execution, in the order of time.
struct Trace {
  std::string problem;
  std::vector<std::string> parts = {};  // names of the parts, by PartId
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

// Writes one JSON object per line (trace.schema.json): first a header, then the events. Equal
// traces give equal bytes.
void WriteTrace(const Trace& trace, std::ostream& out);

// Reads what WriteTrace has written. `file` names the text in errors. Throws InputError, with the
// line, if the text is not a trace, or if it was cut off before the end of the execution.
Trace ReadTrace(std::string_view text, const std::string& file);

}  // namespace assay::execution
