#include "sim/view/unproved_way_data.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "planner/assembly/travel/unproved_ways.h"
#include "planner/plan/certificates/condition_table.h"
#include "sim/view/why_not_data.h"

namespace assay::view {
namespace {

using Json = nlohmann::ordered_json;

// Returns the reason with only those parts in its situation that come too near to something.
plan::Reason WithoutOtherParts(plan::Reason why) {
  if (!why.situation) return why;
  const std::vector<plan::NamedBody>& colliding = why.situation->colliding;
  std::erase_if(why.situation->parts, [&](const domain::PlacedPart& placed) {
    return std::ranges::count(colliding, placed.part, &plan::NamedBody::part) == 0;
  });
  return why;
}

// Removes all ghosts except those of the bodies that come together. The whole arm would hide the
// place where they meet.
void KeepMarkedGhosts(Json& data) {
  if (!data.contains("ghosts")) return;
  Json kept = Json::array();
  for (const Json& ghost : data["ghosts"]) {
    if (std::ranges::count(data["marked"], ghost["body"]) > 0) kept.push_back(ghost);
  }
  data["ghosts"] = std::move(kept);
}

Json DataOfWay(const assembly::UnprovedWay& way, const domain::Problem& problem,
               const scene::Scene& scene) {
  Json data = WhyNotOf({{"", {WithoutOtherParts(way.why)}}}, problem, scene)[0]["reasons"][0];
  KeepMarkedGhosts(data);
  data["condition"] = way.condition.name();
  data["home"] = way.step.IsNone();
  if (way.share) data["share"] = *way.share;
  return data;
}

}  // namespace

void AddUnprovedWays(const domain::Problem& problem, const plan::Plan& plan,
                     const scene::Scene& scene, Json& steps) {
  for (Json& step : steps) step["unprovedWays"] = Json::array();
  for (const assembly::UnprovedWay& way : assembly::UnprovedWays(problem, plan)) {
    const plan::StepId owner = way.step.IsNone() ? plan.ExecutionOrder().back() : way.step;
    for (Json& step : steps) {
      if (step["planned"] != true || step["planNumber"] != plan.step(owner).executed) continue;
      step["unprovedWays"].push_back(DataOfWay(way, problem, scene));
    }
  }
}

}  // namespace assay::view
