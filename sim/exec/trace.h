#pragma once

#include <iosfwd>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "planner/plan/plan.h"
#include "sim/exec/world_model.h"
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

// That a sensor was to look at a part, and where the part is believed to be. Nothing is measured
// (Look).
struct LookRecord {
  double time = 0;
  PartId part;
  std::string sensor;
  Pose believed;  // world frame
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

// How the execution of a plan ended.
enum class ExecutionOutcome {
  kDone,           // every command was executed; what came of it, the checks tell
  kUnreachable,    // the arm cannot go a way that a command wants
  kOverload,       // the wrist felt more force than it may: protective stop
  kEngineWarning,  // the engine's numbers cannot be trusted
};
std::string_view Name(ExecutionOutcome outcome);

struct ExecutionEnd {
  ExecutionOutcome outcome = ExecutionOutcome::kDone;
  std::string reason = {};  // empty if done
  Moment moment;
};

using TraceEvent = std::variant<Sample, GraspFact, LookRecord, StepEnd, RestRecord, ExecutionEnd>;

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
