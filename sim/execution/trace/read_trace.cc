#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "planner/base/input_files/input_error.h"
#include "sim/execution/trace/contact_point_lines.h"
#include "sim/execution/trace/trace.h"

namespace assay::execution {
namespace {

using TraceLine = nlohmann::json;

Vector3 VectorOf(const TraceLine& line) {
  return {line.at(0).get<double>(), line.at(1).get<double>(), line.at(2).get<double>()};
}

Pose PoseOf(const TraceLine& line) {
  const TraceLine& q = line.at("quaternion");
  const Eigen::Quaterniond turn(q.at(0).get<double>(), q.at(1).get<double>(), q.at(2).get<double>(),
                                q.at(3).get<double>());
  Pose pose = Pose::Identity();
  pose.linear() = turn.normalized().toRotationMatrix();
  pose.translation() = VectorOf(line.at("position"));
  return pose;
}

TrueAndBelieved PosesOf(const TraceLine& line) {
  return {PoseOf(line.at("true")), PoseOf(line.at("believed"))};
}

// Returns the value of an enumeration that has this name. The values are counted from 0 to `last`.
template <class Value>
Value Named(const std::string& name, Value last) {
  for (int i = 0; i <= static_cast<int>(last); ++i) {
    if (Name(static_cast<Value>(i)) == name) return static_cast<Value>(i);
  }
  throw std::invalid_argument(fmt::format("'{}' is unknown", name));
}

TrialOutcome OutcomeNamed(const std::string& name) {
  return name == NameOfEnd(TrialOutcome::kSucceeded) ? TrialOutcome::kSucceeded
                                                     : Named(name, TrialOutcome::kDropped);
}

domain::RecoveryStrategy StrategyNamed(const std::string& name) {
  const std::vector<std::string> names = domain::RecoveryStrategyNames();
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) throw std::invalid_argument(fmt::format("'{}' is unknown", name));
  return static_cast<domain::RecoveryStrategy>(found - names.begin());
}

// Converts lines to events.
class TraceParser {
 public:
  explicit TraceParser(const TraceLine& header) {
    if (header.at("format") != "assay-trace/1") throw std::invalid_argument("not assay-trace/1");
    trace_.problem = header.at("problem").get<std::string>();
    trace_.parts = header.at("parts").get<std::vector<std::string>>();
  }

  void Add(const TraceLine& line) { trace_.events.push_back(EventOf(line)); }
  bool IsComplete() const {
    return !trace_.events.empty() && std::holds_alternative<ExecutionEnd>(trace_.events.back());
  }
  Trace Take() { return std::move(trace_); }

 private:
  TraceEvent EventOf(const TraceLine& line) {
    const std::string kind = line.at("kind");
    if (kind == "start") return ExecutionStart{SnapshotOf(line)};
    if (kind == "sample") return SampleOf(line);
    if (kind == "grasp") return GraspOf(line);
    if (kind == "look") return LookOf(line);
    if (kind == "guard") return GuardOf(line);
    if (kind == "motion") return MotionOf(line);
    if (kind == "milestone") return MilestoneOf(line);
    if (kind == "verification") return VerificationOf(line);
    if (kind == "recovery") return RecoveryOf(line);
    if (kind == "step") return StepEndOf(line);
    if (kind == "rest") return RestOf(line);
    if (kind == "collision") {
      return CollisionRecord{line.at("time"), line.at("robot"), line.at("other")};
    }
    if (kind == "end") return EndOf(line);
    throw std::invalid_argument(fmt::format("'{}' is no kind of line", kind));
  }

  PartId PartNamed(const std::string& name) const {
    const auto found = std::ranges::find(trace_.parts, name);
    if (found == trace_.parts.end()) {
      throw std::invalid_argument(fmt::format("there is no part '{}'", name));
    }
    return PartId(static_cast<int>(found - trace_.parts.begin()));
  }

  Snapshot SnapshotOf(const TraceLine& line) const {
    const TraceLine& wrist = line.at("wrist");
    Snapshot snapshot{.time = line.at("time"),
                      .tool = PosesOf(line.at("tool")),
                      .table_heights = line.at("table_heights").get<std::vector<double>>(),
                      .opening = line.at("opening"),
                      .wrist = {VectorOf(wrist.at("force")), VectorOf(wrist.at("torque"))},
                      .contacts = line.at("contacts").get<decltype(Snapshot::contacts)>()};
    for (const std::string& part : trace_.parts) {
      snapshot.parts.push_back(PosesOf(line.at("parts").at(part)));
    }
    for (const TraceLine& arm : line.at("arms")) {
      const auto joints = arm.at("joints").get<std::vector<double>>();
      if (joints.size() != 6) throw std::invalid_argument("an arm has not 6 joints");
      snapshot.arms.push_back({scene::JointVector(joints.data()), arm.at("opening").get<double>()});
    }
    return snapshot;
  }

  Sample SampleOf(const TraceLine& line) {
    Sample sample{SnapshotOf(line)};
    if (const auto field = line.find("contact_points"); field != line.end()) {
      sample.contact_points = contact_points_.PointsOf(sample.snapshot, *field);
    }
    return sample;
  }

  GraspFact GraspOf(const TraceLine& line) const {
    return {.time = line.at("time"),
            .part = PartNamed(line.at("part")),
            .expected_width = line.at("expected_width"),
            .opening = line.at("opening"),
            .pads_touch = line.at("pads_touch")};
  }
  LookRecord LookOf(const TraceLine& line) const {
    LookRecord look{.time = line.at("time"),
                    .part = PartNamed(line.at("part")),
                    .sensor = line.at("sensor"),
                    .found = line.at("found"),
                    .measured = Pose::Identity(),
                    .before = PosesOf(line.at("before")),
                    .believed = PoseOf(line.at("believed"))};
    if (look.found) look.measured = PoseOf(line.at("measured"));
    return look;
  }
  static GuardRecord GuardOf(const TraceLine& line) {
    return {.time = line.at("time"),
            .resisted = line.at("resisted"),
            .tool = PoseOf(line.at("tool")),
            .from = line.at("from"),
            .force = line.at("force"),
            .direction = VectorOf(line.at("direction"))};
  }
  // The trace does not tell when an error state was felt; it was at the end of its motion at the
  // latest.
  static MotionRecord MotionOf(const TraceLine& line) {
    MotionRecord motion{.time = line.at("time"),
                        .step = plan::StepId(line.at("step").get<int>()),
                        .motion = line.at("motion").get<int>() - 1,
                        .attempt = line.at("attempt"),
                        .outcome = OutcomeNamed(line.at("outcome"))};
    const TraceLine& recognized = line.at("recognized");
    if (!recognized.is_null()) {
      motion.recognized =
          RecognizedContact{recognized.at("contact"), recognized.at("loss"), motion.time};
    }
    return motion;
  }
  Milestone MilestoneOf(const TraceLine& line) const {
    return {plan::StepId(line.at("step").get<int>()), Named(line.at("stage"), Stage::kActed),
            SnapshotOf(line)};
  }
  static VerificationRecord VerificationOf(const TraceLine& line) {
    return {.time = line.at("time"),
            .step = plan::StepId(line.at("step").get<int>()),
            .name = line.at("name"),
            .measured = line.at("measured"),
            .expected = line.at("expected"),
            .tolerance = line.at("tolerance"),
            .error = line.at("error")};
  }
  static RecoveryRecord RecoveryOf(const TraceLine& line) {
    return {.time = line.at("time"),
            .step = plan::StepId(line.at("step").get<int>()),
            .error = line.at("error"),
            .strategy = StrategyNamed(line.at("strategy")),
            .attempt = line.at("attempt"),
            .offset = VectorOf(line.at("offset"))};
  }
  // A step is named "action_3" after its index, counted from 1.
  StepEnd StepEndOf(const TraceLine& line) const {
    const std::string name = line.at("step");
    const int number = std::stoi(name.substr(name.find('_') + 1));
    return {plan::StepId(number - 1), name, line.at("action"), SnapshotOf(line)};
  }
  RestRecord RestOf(const TraceLine& line) const {
    RestRecord rest{.duration = line.at("duration")};
    for (const std::string& part : trace_.parts) {
      const TraceLine& speeds = line.at("parts").at(part);
      rest.parts.push_back({speeds.at("linear").get<double>(), speeds.at("angular").get<double>()});
    }
    return rest;
  }
  ExecutionEnd EndOf(const TraceLine& line) const {
    return {.outcome = OutcomeNamed(line.at("outcome")),
            .reason = line.at("reason"),
            .snapshot = SnapshotOf(line),
            .steps = line.at("steps")};
  }

  Trace trace_;
  ContactPointReader contact_points_;
};

}  // namespace

Trace ReadTrace(std::string_view text, const std::string& file) {
  std::optional<TraceParser> parser;
  int number = 0;
  try {
    for (std::size_t begin = 0; begin < text.size();) {
      ++number;
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      const TraceLine line = TraceLine::parse(text.substr(begin, end - begin));
      begin = end + 1;
      if (parser) {
        parser->Add(line);
      } else {
        parser.emplace(line);
      }
    }
  } catch (const std::exception& error) {
    throw InputError({.file = file, .line = number}, error.what(),
                     "a trace as assay run -o writes it");
  }
  if (parser && parser->IsComplete()) return parser->Take();
  throw InputError({.file = file, .line = number}, "the trace has no end",
                   "a trace as assay run -o writes it");
}

}  // namespace assay::execution
