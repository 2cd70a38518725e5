#include "sim/cli/plan_output/part_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "planner/geometry/solids/mass_properties.h"
#include "sim/cli/options/quantity.h"
#include "sim/cli/plan_output/table.h"

namespace assay::cli {
namespace {

using Json = nlohmann::ordered_json;
using domain::FeatureNumber;
using domain::PartModel;

// Returns the numbers as text: "7 8", or "-" if there are none.
std::string FeatureText(const std::vector<FeatureNumber>& numbers) {
  std::vector<int> plain;
  for (const FeatureNumber number : numbers) plain.push_back(number.index());
  return plain.empty() ? "-" : fmt::format("{}", fmt::join(plain, " "));
}

Json NumbersToJson(const std::vector<FeatureNumber>& numbers) {
  Json json = Json::array();
  for (const FeatureNumber number : numbers) json.push_back(number.index());
  return json;
}

Json VectorToJson(const geometry::Vector3& v) { return Json::array({v.x(), v.y(), v.z()}); }

std::string GraspTable(const std::vector<domain::Grasp>& grasps) {
  Table table({{"grasp"}, {"width mm", Align::kRight}, {"approach"}, {"closing"}, {"hides"}});
  for (const domain::Grasp& grasp : grasps) {
    table.Add({grasp.label, fmt::format("{:.1f}", grasp.width * 1000),
               DirectionText(grasp.X_PartTool.linear().col(2)),
               DirectionText(grasp.X_PartTool.linear().col(1)), FeatureText(grasp.hidden)});
  }
  return table.Text();
}

Json GraspsToJson(const std::vector<domain::Grasp>& grasps) {
  Json json = Json::array();
  for (const domain::Grasp& grasp : grasps) {
    json.push_back({{"label", grasp.label},
                    {"width", grasp.width},
                    {"approach", VectorToJson(grasp.X_PartTool.linear().col(2))},
                    {"closing", VectorToJson(grasp.X_PartTool.linear().col(1))},
                    {"origin", VectorToJson(grasp.X_PartTool.translation())},
                    {"hidden", NumbersToJson(grasp.hidden)}});
  }
  return json;
}

}  // namespace

// Returns three decimals, without "-0.000".
std::string DirectionText(const geometry::Vector3& v) {
  const auto rounded = [](double x) { return std::round(1000 * x) / 1000 + 0.0; };
  return fmt::format("{:.3f} {:.3f} {:.3f}", rounded(v.x()), rounded(v.y()), rounded(v.z()));
}

std::string StablePoseText(const PartModel& part, domain::StablePoseId id) {
  if (id.IsNone()) return "leaning or mated";
  const domain::StablePose& pose = part.stable_poses()[id.index()];
  return pose.name.empty() ? pose.label : fmt::format("{} {}", pose.label, pose.name);
}

std::string StablePoseTable(const PartModel& part) {
  Table table({{"pose"}, {"name"}, {"tips at deg", Align::kRight}, {"hides"}});
  for (const domain::StablePose& pose : part.stable_poses()) {
    table.Add({pose.label, pose.name.empty() ? "-" : pose.name,
               fmt::format("{:.1f}", pose.tilt_margin / kDegree), FeatureText(pose.hidden)});
  }
  return table.Text();
}

Json StablePosesToJson(const PartModel& part) {
  Json json = Json::array();
  for (const domain::StablePose& pose : part.stable_poses()) {
    json.push_back({{"label", pose.label},
                    {"name", pose.name},
                    {"tilt_margin", pose.tilt_margin},
                    {"hidden", NumbersToJson(pose.hidden)}});
  }
  return json;
}

Report ReportOn(const PartModel& part, const std::vector<domain::Grasp>& grasps) {
  Report report;
  report.text =
      fmt::format("part {}: {:.3f} kg, {} features, {} stable poses, {} grasps\n\n{}\n{}",
                  part.name(), part.mass().mass, part.features().size(), part.stable_poses().size(),
                  grasps.size(), StablePoseTable(part), GraspTable(grasps));
  report.json = std::make_shared<const Json>(Json{{"part", part.name()},
                                                  {"mass", part.mass().mass},
                                                  {"stable_poses", StablePosesToJson(part)},
                                                  {"grasps", GraspsToJson(grasps)}});
  return report;
}

}  // namespace assay::cli
