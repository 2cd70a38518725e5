#include "planner/plan/plan_files/recovery_file.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "planner/domain/units/units.h"

namespace assay::plan {
namespace {

constexpr double kLeastPitch = 1e-5;  // metres

using Json = nlohmann::ordered_json;

double ReadLength(const Value& value) {
  return domain::ReadWithin(value, domain::kMetres, domain::kAtLeastZero);
}

std::string ReadErrorName(const Value& owner, std::string_view key) {
  const std::optional<Value> error = owner.Find(key);
  if (!error) return "";
  if (error->Text().empty()) error->Fail("an error without a name", "a name");
  return error->Text();
}

}  // namespace

Json ToJson(const Verification& verification, const std::vector<std::string>& step_names) {
  const auto quantity = static_cast<std::size_t>(verification.quantity);
  Json json = {{"step", step_names[verification.step.index()]},
               {"name", verification.name},
               {"measures", domain::MeasuredQuantityNames()[quantity]},
               {"expected", verification.expected},
               {"tolerance", verification.tolerance}};
  if (!verification.below.empty()) json["below"] = verification.below;
  if (!verification.above.empty()) json["above"] = verification.above;
  return json;
}

Json ToJson(const Recovery& recovery, const std::vector<std::string>& step_names) {
  const auto strategy = static_cast<std::size_t>(recovery.strategy);
  Json json = {{"step", step_names[recovery.step.index()]},
               {"error", recovery.error},
               {"strategy", domain::RecoveryStrategyNames()[strategy]}};
  if (recovery.strategy == domain::RecoveryStrategy::kGropingSearch) {
    json["radius"] = recovery.radius;
    json["pitch"] = recovery.pitch;
  }
  return json;
}

Verification ReadVerification(const Value& value, const std::vector<std::string>& step_names) {
  value.AllowOnly({"step", "name", "measures", "expected", "tolerance", "below", "above"});
  return {.step = StepId(value.At("step").OneOf(step_names)),
          .name = value.At("name").Text(),
          .quantity = static_cast<domain::MeasuredQuantity>(
              value.At("measures").OneOf(domain::MeasuredQuantityNames())),
          .expected = value.At("expected").Number(),
          .tolerance = ReadLength(value.At("tolerance")),
          .below = ReadErrorName(value, "below"),
          .above = ReadErrorName(value, "above")};
}

Recovery ReadRecovery(const Value& value, const std::vector<std::string>& step_names) {
  Recovery recovery = {.step = StepId(value.At("step").OneOf(step_names)),
                       .error = value.At("error").Text(),
                       .strategy = static_cast<domain::RecoveryStrategy>(
                           value.At("strategy").OneOf(domain::RecoveryStrategyNames()))};
  if (recovery.strategy != domain::RecoveryStrategy::kGropingSearch) {
    value.AllowOnly({"step", "error", "strategy"});
    return recovery;
  }
  value.AllowOnly({"step", "error", "strategy", "radius", "pitch"});
  recovery.radius = ReadLength(value.At("radius"));
  const Value pitch = value.At("pitch");
  recovery.pitch = ReadLength(pitch);
  // As in workcell files, a search has at least one place, and an end.
  if (recovery.pitch < kLeastPitch || recovery.pitch > recovery.radius) {
    pitch.Fail(
        fmt::format("the pitch {} m does not suit the radius of this search", recovery.pitch),
        fmt::format("{} m to the radius, {} m", kLeastPitch, recovery.radius));
  }
  return recovery;
}

}  // namespace assay::plan
