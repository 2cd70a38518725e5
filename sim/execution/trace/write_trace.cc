#include <nlohmann/json.hpp>
#include <ostream>

#include "sim/execution/trace/contact_point_lines.h"
#include "sim/execution/trace/trace.h"

namespace assay::execution {
namespace {

using Json = nlohmann::ordered_json;

Json ToJson(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

// Writes the quaternion with w >= 0, of the two that a rotation has.
Json ToJson(const Pose& pose) {
  Eigen::Quaterniond turn(pose.linear());
  if (turn.w() < 0) turn.coeffs() = -turn.coeffs();
  return {{"position", ToJson(Vector3(pose.translation()))},
          {"quaternion", {turn.w(), turn.x(), turn.y(), turn.z()}}};
}

Json ToJson(const TrueAndBelieved& poses) {
  return {{"true", ToJson(poses.truth)}, {"believed", ToJson(poses.believed)}};
}

// Converts events to lines.
class TraceWriter {
 public:
  explicit TraceWriter(const Trace& trace) : trace_(trace) {}

  Json Header() const {
    return {{"format", "assay-trace/1"}, {"problem", trace_.problem}, {"parts", trace_.parts}};
  }
  Json operator()(const Sample& sample) {
    Json json = Of("sample", sample.snapshot);
    if (sample.contact_points) json["contact_points"] = contact_points_.FieldOf(sample);
    return json;
  }
  Json operator()(const GraspFact& fact) const {
    return {{"kind", "grasp"},         {"time", fact.time},
            {"part", Name(fact.part)}, {"expected_width", fact.expected_width},
            {"opening", fact.opening}, {"pads_touch", fact.pads_touch},
            {"holds", fact.holds()}};
  }
  Json operator()(const LookRecord& look) const {
    Json json = {{"kind", "look"},        {"time", look.time},   {"part", Name(look.part)},
                 {"sensor", look.sensor}, {"found", look.found}, {"before", ToJson(look.before)}};
    if (look.found) json["measured"] = ToJson(look.measured);
    json["believed"] = ToJson(look.believed);
    return json;
  }
  Json operator()(const GuardRecord& guard) const {
    return {{"kind", "guard"},
            {"time", guard.time},
            {"resisted", guard.resisted},
            {"tool", ToJson(guard.tool)},
            {"from", guard.from},
            {"force", guard.force},
            {"direction", ToJson(guard.direction)}};
  }
  Json operator()(const MotionRecord& motion) const {
    Json recognized;
    if (motion.recognized) {
      recognized = {{"contact", motion.recognized->name}, {"loss", motion.recognized->is_loss}};
    }
    return {{"kind", "motion"},
            {"time", motion.time},
            {"step", motion.step.index()},
            {"motion", motion.motion + 1},
            {"attempt", motion.attempt},
            {"outcome", NameOfEnd(motion.outcome)},
            {"recognized", recognized}};
  }
  Json operator()(const Milestone& milestone) const {
    Json json = Of("milestone", milestone.snapshot);
    json["step"] = milestone.step.index();
    json["stage"] = execution::Name(milestone.stage);
    return json;
  }
  Json operator()(const VerificationRecord& check) const {
    return {{"kind", "verification"},       {"time", check.time},
            {"step", check.step.index()},   {"name", check.name},
            {"measured", check.measured},   {"expected", check.expected},
            {"tolerance", check.tolerance}, {"error", check.error}};
  }
  Json operator()(const RecoveryRecord& recovery) const {
    const auto strategy = static_cast<std::size_t>(recovery.strategy);
    return {{"kind", "recovery"},
            {"time", recovery.time},
            {"step", recovery.step.index()},
            {"error", recovery.error},
            {"strategy", domain::RecoveryStrategyNames()[strategy]},
            {"attempt", recovery.attempt},
            {"offset", ToJson(recovery.offset)}};
  }
  Json operator()(const StepEnd& end) const {
    Json json = Of("step", end.snapshot);
    json["step"] = end.name;
    json["action"] = end.action;
    return json;
  }
  Json operator()(const RestRecord& rest) const {
    Json parts = Json::object();
    for (std::size_t i = 0; i < rest.parts.size(); ++i) {
      parts[trace_.parts[i]] = {{"linear", rest.parts[i].linear},
                                {"angular", rest.parts[i].angular}};
    }
    return {{"kind", "rest"}, {"duration", rest.duration}, {"parts", parts}};
  }
  Json operator()(const CollisionRecord& collision) const {
    return {{"kind", "collision"},
            {"time", collision.time},
            {"robot", collision.robot},
            {"other", collision.other}};
  }
  Json operator()(const ExecutionStart& start) const { return Of("start", start.snapshot); }
  Json operator()(const ExecutionEnd& end) const {
    Json json = Of("end", end.snapshot);
    json["outcome"] = NameOfEnd(end.outcome);
    json["reason"] = end.reason;
    json["steps"] = end.steps;
    return json;
  }

 private:
  Json Of(const char* kind, const Snapshot& snapshot) const {
    Json parts = Json::object();
    for (std::size_t i = 0; i < snapshot.parts.size(); ++i) {
      parts[trace_.parts[i]] = ToJson(snapshot.parts[i]);
    }
    Json contacts = Json::array();
    for (const auto& [a, b] : snapshot.contacts) contacts.push_back({a, b});
    Json arms = Json::array();
    for (const auto& [q, opening] : snapshot.arms) {
      arms.push_back({{"joints", std::vector(q.begin(), q.end())}, {"opening", opening}});
    }
    return {{"kind", kind},
            {"time", snapshot.time},
            {"tool", ToJson(snapshot.tool)},
            {"opening", snapshot.opening},
            {"wrist",
             {{"force", ToJson(snapshot.wrist.force)}, {"torque", ToJson(snapshot.wrist.torque)}}},
            {"parts", parts},
            {"table_heights", snapshot.table_heights},
            {"contacts", contacts},
            {"arms", arms}};
  }
  const std::string& Name(PartId part) const { return trace_.parts[part.index()]; }

  const Trace& trace_;
  ContactPointWriter contact_points_;
};

}  // namespace

void WriteTrace(const Trace& trace, std::ostream& out) {
  TraceWriter writer(trace);
  out << writer.Header().dump() << '\n';
  for (const TraceEvent& event : trace.events) out << std::visit(writer, event).dump() << '\n';
}

}  // namespace assay::execution
