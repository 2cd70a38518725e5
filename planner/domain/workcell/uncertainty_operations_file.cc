#include "planner/domain/workcell/uncertainty_operations_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "planner/domain/actions/actions.h"
#include "planner/domain/problem/name.h"
#include "planner/domain/problem/pose_error_file.h"

namespace assay::domain {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Interval kWholeLine = {-kInfinity, kInfinity};
constexpr PoseError kNotMeasured = {kWholeLine, kWholeLine, kWholeLine, kWholeLine};
constexpr Range kTolerances = {1e-6, 0.1};     // metres
constexpr Range kSearchRadii = {1e-4, 0.5};    // metres
constexpr Range kSearchPitches = {1e-5, 0.1};  // metres

SensorModel ReadSensor(const Value& key, const Value& entry, const Units& units) {
  entry.AllowOnly({"description", "error"});
  SensorModel sensor{
      .name = ReadAnyName(key), .description = {}, .x = {}, .y = {}, .z = {}, .theta = {}};
  if (const auto description = entry.Find("description")) sensor.description = description->Text();
  const Value map = entry.At("error");
  if (map.Entries().empty()) {
    map.Fail(fmt::format("the sensor '{}' measures nothing", sensor.name),
             "at least one of x, y, z, theta");
  }
  const PoseError error = ReadPoseError(map, units, kNotMeasured);
  sensor.x = error.x;
  sensor.y = error.y;
  sensor.z = error.z;
  sensor.theta = error.theta;
  return sensor;
}

// Reads the kind of action that a verification follows.
const ActionKind* ReadVerified(const Value& name) {
  ActionKinds kinds = StandardActions();
  std::erase_if(kinds, [](const ActionKind* kind) { return !kind->measured; });
  std::vector<std::string> names;
  for (const ActionKind* kind : kinds) names.emplace_back(kind->name);
  return kinds[name.OneOf(names)];
}

VerificationTemplate ReadVerification(const Value& key, const Value& entry, const Units& units) {
  entry.AllowOnly({"after", "measures", "tolerance", "below", "above"});
  VerificationTemplate verification;
  verification.name = ReadAnyName(key);
  const Value after = entry.At("after");
  verification.after = ReadVerified(after);
  const Value measures = entry.At("measures");
  verification.quantity = static_cast<MeasuredQuantity>(measures.OneOf(MeasuredQuantityNames()));
  const MeasuredQuantity fitting = *verification.after->measured;
  if (verification.quantity != fitting) {
    measures.Fail(fmt::format("after {} there is no {} to measure", after.Text(), measures.Text()),
                  MeasuredQuantityNames()[static_cast<std::size_t>(fitting)]);
  }
  verification.tolerance = ReadWithin(entry.At("tolerance"), units.length, kTolerances);
  if (const auto below = entry.Find("below")) verification.below = ReadAnyName(*below);
  if (const auto above = entry.Find("above")) verification.above = ReadAnyName(*above);
  if (verification.below.empty() && verification.above.empty()) {
    entry.Fail("a verification that signals no error", "at least one of below, above");
  }
  return verification;
}

RecoveryTemplate ReadRecovery(const Value& key, const Value& entry, const Units& units) {
  RecoveryTemplate recovery;
  recovery.error = ReadAnyName(key);
  recovery.strategy =
      static_cast<RecoveryStrategy>(entry.At("strategy").OneOf(RecoveryStrategyNames()));
  if (recovery.strategy != RecoveryStrategy::kGropingSearch) {
    entry.AllowOnly({"strategy"});
    return recovery;
  }
  entry.AllowOnly({"strategy", "radius", "pitch"});
  recovery.radius = ReadWithin(entry.At("radius"), units.length, kSearchRadii);
  const Value pitch = entry.At("pitch");
  recovery.pitch = ReadWithin(pitch, units.length, kSearchPitches);
  if (recovery.pitch > recovery.radius) {
    pitch.Fail("the pitch is greater than the radius, so that there is nothing to try",
               fmt::format("at most {}", InUnit(recovery.radius, units.length)));
  }
  return recovery;
}

void RequireRecoveries(const Value& verification, const std::vector<RecoveryTemplate>& recoveries) {
  std::vector<std::string> answered;
  for (const RecoveryTemplate& recovery : recoveries) answered.push_back(recovery.error);
  for (const char* side : {"below", "above"}) {
    const auto error = verification.Find(side);
    if (!error || std::ranges::count(answered, error->Text()) > 0) continue;
    if (answered.empty()) {
      error->Fail(fmt::format("there is no recovery from '{}'", error->Text()),
                  "an entry for it in the section recoveries");
    }
    error->OneOf(answered);
  }
}

}  // namespace

UncertaintyOperations ReadUncertaintyOperations(const Value& root, const Units& units) {
  UncertaintyOperations operations;
  if (const auto sensors = root.Find("sensors")) {
    for (const auto& [key, entry] : sensors->Entries()) {
      operations.sensors.push_back(ReadSensor(key, entry, units));
    }
  }
  if (const auto recoveries = root.Find("recoveries")) {
    for (const auto& [key, entry] : recoveries->Entries()) {
      operations.recoveries.push_back(ReadRecovery(key, entry, units));
    }
  }
  if (const auto verifications = root.Find("verifications")) {
    for (const auto& [key, entry] : verifications->Entries()) {
      operations.verifications.push_back(ReadVerification(key, entry, units));
      RequireRecoveries(entry, operations.recoveries);
    }
  }
  return operations;
}

}  // namespace assay::domain
