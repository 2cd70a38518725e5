#include "sim/cli/problem_report.h"

#include <fmt/format.h>

#include <set>

#include "planner/domain/reachability.h"
#include "sim/cli/effective_clearance.h"
#include "sim/cli/part_report.h"
#include "sim/cli/table.h"

namespace assay::cli {
namespace {

using Json = nlohmann::ordered_json;
using domain::PartId;
using domain::Problem;

// How many grasps reach the part where it is at the start, other parts left aside.
int CountReachable(const Problem& problem, PartId id) {
  const domain::Part& part = problem.part(id);
  int count = 0;
  for (std::size_t g = 0; g < part.grasps->size(); ++g) {
    if (domain::IsReachableAt(problem, id, domain::GraspId(g), part.X_WorldPart)) ++count;
  }
  return count;
}

std::string PositionText(const geometry::Pose& X) {
  const geometry::Vector3 mm = 1000 * X.translation();
  return fmt::format("{:.1f} {:.1f} {:.1f}", mm.x(), mm.y(), mm.z());
}

void AddParts(const Problem& problem, Report& report) {
  Table table({{"part"},
               {"model"},
               {"stable poses", Align::kRight},
               {"starts"},
               {"at mm"},
               {"grasps", Align::kRight},
               {"reachable at start", Align::kRight}});
  report.json["parts"] = Json::array();
  for (std::size_t p = 0; p < problem.parts.size(); ++p) {
    const domain::Part& part = problem.parts[p];
    const int reachable = CountReachable(problem, PartId(p));
    const std::string start = StablePoseText(*part.model, part.resting);
    table.Add({part.name, part.model->name(), std::to_string(part.model->stable_poses().size()),
               start, PositionText(part.X_WorldPart), std::to_string(part.grasps->size()),
               std::to_string(reachable)});
    report.json["parts"].push_back({{"name", part.name},
                                    {"model", part.model->name()},
                                    {"start", start},
                                    {"grasps", part.grasps->size()},
                                    {"reachable_at_start", reachable},
                                    {"stable_poses", StablePosesToJson(*part.model)}});
  }
  report.text += table.Text();
}

void AddStablePoses(const Problem& problem, Report& report) {
  std::set<std::string> told;
  for (const domain::Part& part : problem.parts) {
    if (!told.insert(part.model->name()).second) continue;
    report.text +=
        fmt::format("\nstable poses of {}\n{}", part.model->name(), StablePoseTable(*part.model));
  }
}

void AddClearances(const Problem& problem, Report& report) {
  const scene::Scene scene(problem, {});
  Table table({{"mating"},
               {"clearance mm", Align::kRight},
               {"in the engine: +x", Align::kRight},
               {"-x", Align::kRight},
               {"+y", Align::kRight},
               {"-y", Align::kRight},
               {"verdict"}});
  report.json["clearances"] = Json::array();
  for (const EffectiveClearance& clearance : MeasureClearances(problem, scene)) {
    const domain::Mating& mating = problem.mating(clearance.mating);
    const std::string& held = problem.part(mating.held).name;
    const std::string& fixed = problem.part(mating.fixed).name;
    const bool holds = clearance.worst_deviation <= kClearanceDeviation;
    std::vector<std::string> row = {fmt::format("{} in {}", held, fixed),
                                    fmt::format("{:.4f}", 1000 * clearance.nominal)};
    for (const double gap : clearance.gaps) row.push_back(fmt::format("{:.4f}", 1000 * gap));
    row.push_back(holds ? "holds" : fmt::format("{:.0f} % off", 100 * clearance.worst_deviation));
    table.Add(std::move(row));
    report.json["clearances"].push_back({{"held", held},
                                         {"fixed", fixed},
                                         {"nominal", clearance.nominal},
                                         {"effective", clearance.gaps},
                                         {"deviation", clearance.worst_deviation},
                                         {"holds", holds}});
    report.holds = report.holds && holds;
  }
  if (!report.json["clearances"].empty()) report.text += "\n" + table.Text();
}

}  // namespace

Report ReportOn(const Problem& problem) {
  Report report;
  report.text = fmt::format("scenario {}: {}\nworkcell {}, {} parts, {} goals\n\n", problem.name,
                            problem.title, problem.workcell->name(), problem.parts.size(),
                            problem.goals.size());
  report.json = {{"scenario", problem.name},
                 {"title", problem.title},
                 {"workcell", problem.workcell->name()},
                 {"goals", problem.goals.size()}};
  AddParts(problem, report);
  AddStablePoses(problem, report);
  AddClearances(problem, report);
  return report;
}

}  // namespace assay::cli
