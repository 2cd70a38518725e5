#include "sim/view/occurrence_data.h"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "planner/domain/units/units.h"
#include "sim/view/pose_data.h"

namespace assay::view {
namespace {

using domain::InUnit;
using domain::kMillimetres;
using Json = nlohmann::ordered_json;

Json Occurrence(double time, bool is_bad, std::string text) {
  return {{"time", time}, {"bad", is_bad}, {"text", std::move(text)}};
}

// Returns the data of each event that happens at a single time, and null for all other events.
class Teller {
 public:
  explicit Teller(const execution::Trace& trace) : trace_(trace) {}

  Json operator()(const execution::GraspFact& fact) const {
    return Occurrence(
        fact.time, !fact.holds(),
        fmt::format("the pads closed on {} at {}, expected {}", Name(fact.part),
                    InUnit(fact.opening, kMillimetres), InUnit(fact.expected_width, kMillimetres)));
  }
  Json operator()(const execution::LookRecord& look) const {
    return Occurrence(
        look.time, !look.found,
        fmt::format("{} {} {}", look.sensor, look.found ? "saw" : "did not see", Name(look.part)));
  }
  Json operator()(const execution::VerificationRecord& check) const {
    return Occurrence(
        check.time, !check.error.empty(),
        fmt::format("check {}: {}, expected {} +- {}{}", check.name,
                    InUnit(check.measured, kMillimetres), InUnit(check.expected, kMillimetres),
                    InUnit(check.tolerance, kMillimetres),
                    check.error.empty() ? "" : ": " + check.error));
  }
  Json operator()(const execution::RecoveryRecord& recovery) const {
    const auto strategy = static_cast<std::size_t>(recovery.strategy);
    return Occurrence(recovery.time, true,
                      fmt::format("recovery from {}: {}, attempt {}", recovery.error,
                                  domain::RecoveryStrategyNames()[strategy], recovery.attempt));
  }
  Json operator()(const execution::MotionRecord& motion) const {
    const std::string recognized =
        motion.recognized
            ? fmt::format(": {} of {}", motion.recognized->is_loss ? "loss" : "contact",
                          motion.recognized->name)
            : "";
    return Occurrence(motion.time, motion.outcome != execution::TrialOutcome::kSucceeded,
                      fmt::format("motion {} of the strategy: {}{}", motion.motion + 1,
                                  NameOfEnd(motion.outcome), recognized));
  }
  Json operator()(const execution::CollisionRecord& collision) const {
    return Occurrence(collision.time, true,
                      fmt::format("{} touched {}", collision.robot, collision.other));
  }
  Json operator()(const execution::ExecutionEnd& end) const {
    if (end.outcome == execution::TrialOutcome::kSucceeded) return nullptr;
    return Occurrence(end.snapshot.time, true,
                      fmt::format("the execution ended: {}", execution::Name(end.outcome)));
  }
  Json operator()(const auto&) const { return nullptr; }

 private:
  const std::string& Name(domain::PartId part) const { return trace_.parts[part.index()]; }

  const execution::Trace& trace_;
};

}  // namespace

Json OccurrencesOf(const execution::Trace& trace) {
  const Teller teller(trace);
  Json all = Json::array();
  for (const execution::TraceEvent& event : trace.events) {
    Json occurrence = std::visit(teller, event);
    if (!occurrence.is_null()) all.push_back(std::move(occurrence));
  }
  return all;
}

Json GuardsOf(const execution::Trace& trace) {
  Json all = Json::array();
  for (const execution::GuardRecord* guard : trace.All<execution::GuardRecord>()) {
    all.push_back({{"from", guard->from},
                   {"to", guard->time},
                   {"force", guard->force},
                   {"direction", ToJson(guard->direction)},
                   {"resisted", guard->resisted}});
  }
  return all;
}

Json CollisionsOf(const execution::Trace& trace) {
  Json all = Json::array();
  for (const execution::CollisionRecord* collision : trace.All<execution::CollisionRecord>()) {
    all.push_back({{"time", collision->time}, {"bodies", {collision->robot, collision->other}}});
  }
  return all;
}

Json ContactsOf(const execution::Trace& trace) {
  std::map<std::pair<std::string, std::string>, std::vector<std::pair<double, double>>> ranges;
  double last = -1;
  for (const execution::Sample* sample : trace.All<execution::Sample>()) {
    for (const auto& pair : sample->snapshot.contacts) {
      if (pair.first == "world" || pair.second == "world") continue;
      auto& of_pair = ranges[pair];
      if (of_pair.empty() || of_pair.back().second < last) {
        of_pair.emplace_back(sample->snapshot.time, 0);
      }
      of_pair.back().second = sample->snapshot.time;
    }
    last = sample->snapshot.time;
  }
  Json all = Json::array();
  for (const auto& [pair, times] : ranges) {
    all.push_back({{"bodies", {pair.first, pair.second}}, {"times", times}});
  }
  return all;
}

}  // namespace assay::view
