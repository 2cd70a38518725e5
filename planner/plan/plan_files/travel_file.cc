#include "planner/plan/plan_files/travel_file.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "planner/domain/units/units.h"

namespace assay::plan {
namespace {

using Json = nlohmann::ordered_json;
using kinematics::JointVector;

JointVector ReadPosture(const Value& value) {
  const std::vector<Value> items = value.Items();
  if (items.size() != 6) value.Fail(fmt::format("{} joint values", items.size()), "6, in radians");
  JointVector q;
  for (int j = 0; j < 6; ++j) q[j] = items[static_cast<std::size_t>(j)].Number();
  return q;
}

}  // namespace

Json ToJson(const Travel& travel) {
  Json path = Json::array();
  for (const JointVector& q : travel.path) path.push_back(Json(std::vector(q.begin(), q.end())));
  return {{"path", std::move(path)}, {"clearance", travel.clearance}, {"usual", travel.is_usual}};
}

Travel ReadTravel(const Value& value) {
  value.AllowOnly({"path", "clearance", "usual"});
  Travel travel;
  const Value path = value.At("path");
  for (const Value& posture : path.Items()) travel.path.push_back(ReadPosture(posture));
  if (travel.path.size() < 2) {
    path.Fail(fmt::format("{} postures", travel.path.size()), "at least 2");
  }
  travel.clearance =
      domain::ReadWithin(value.At("clearance"), domain::kMetres, domain::kAtLeastZero);
  if (const auto usual = value.Find("usual")) travel.is_usual = usual->Flag();
  return travel;
}

}  // namespace assay::plan
