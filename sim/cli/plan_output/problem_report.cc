#include "sim/cli/plan_output/problem_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <variant>

#include "planner/base/counted.h"
#include "planner/domain/matings/mating_classes.h"
#include "planner/domain/reachability/reachability.h"
#include "sim/check/measurements/effective_clearance.h"
#include "sim/cli/plan_output/part_report.h"
#include "sim/cli/plan_output/table.h"

namespace assay::cli {
namespace {

using Json = nlohmann::ordered_json;
using domain::PartId;
using domain::Problem;

// A report that is being written.
struct Draft {
  std::string text;
  Json json;
  bool holds = true;
};

// Returns how many grasps reach the part where it is at the start. Other parts are ignored.
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

void AddParts(const Problem& problem, Draft& report) {
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

// A part that the goals want moved and that no grasp of the gripper can move, so no plan exists.
struct Unmovable {
  PartId part;
  std::string why;
};

std::optional<Unmovable> UnmovableFor(const Problem& problem, domain::MatingId id) {
  const domain::Mating& mating = problem.mating(id);
  if (std::ranges::count(problem.assembled, id) > 0) return std::nullopt;
  if (problem.part(mating.held).grasps->empty()) {
    return Unmovable{mating.held, "no grasp of the gripper holds it"};
  }
  if (!domain::GraspList(problem, mating).empty()) return std::nullopt;
  return Unmovable{mating.held, "every grasp of it hides a feature that is to mate"};
}

std::optional<Unmovable> UnmovableFor(const Problem& problem, const domain::LocatedGoal& goal) {
  const domain::Part& part = problem.part(goal.part);
  const bool is_there = std::ranges::count(goal.stable_poses, part.resting) > 0;
  if (is_there || !part.grasps->empty()) return std::nullopt;
  return Unmovable{goal.part, "no grasp of the gripper holds it"};
}

void AddUnmovable(const Problem& problem, Draft& report) {
  report.json["unmovable"] = Json::array();
  for (const domain::Goal& goal : problem.goals) {
    const auto unmovable =
        std::visit([&](const auto& wanted) { return UnmovableFor(problem, wanted); }, goal);
    if (!unmovable) continue;
    const std::string& name = problem.part(unmovable->part).name;
    report.text += fmt::format("\na goal wants {} moved, and {}\n", name, unmovable->why);
    report.json["unmovable"].push_back({{"part", name}, {"why", unmovable->why}});
    report.holds = false;
  }
}

void AddStablePoses(const Problem& problem, Draft& report) {
  std::set<std::string> told;
  for (const domain::Part& part : problem.parts) {
    if (!told.insert(part.model->name()).second) continue;
    report.text +=
        fmt::format("\nstable poses of {}\n{}", part.model->name(), StablePoseTable(*part.model));
  }
}

bool Holds(const check::Play& play) {
  return std::abs(play.RelativeDifference()) <= check::kPlayTolerance;
}

void AddTolerances(const Problem& problem, Draft& report) {
  const domain::Tolerances& tolerances = problem.tolerances;
  report.json["clearance"] = problem.clearance;
  report.json["tolerances"] = {{"clearance", tolerances.clearance},
                               {"friction", tolerances.friction},
                               {"pad_friction", tolerances.pad_friction}};
  if (tolerances == domain::Tolerances{}) return;
  const domain::WorkcellRules& rules = problem.workcell->rules();
  report.text += fmt::format(
      "\nclearance {:.4g} mm within {:.4g} mm, friction {:.4g} within {:.4g}, of the pads {:.4g} "
      "within {:.4g}\n",
      1000 * problem.clearance, 1000 * tolerances.clearance, rules.friction, tolerances.friction,
      rules.pad_friction, tolerances.pad_friction);
}

void AddClearances(const Problem& problem, Draft& report) {
  Table table({{"mating"},
               {"along"},
               {"play mm", Align::kRight},
               {"in the engine mm", Align::kRight},
               {"off by %", Align::kRight},
               {"verdict"}});
  std::string without_play;
  Json& json = report.json["clearances"] = Json::array();
  for (std::size_t m = 0; m < problem.matings.size(); ++m) {
    const domain::Mating& mating = problem.matings[m];
    const std::string& held = problem.part(mating.held).name;
    const std::string& fixed = problem.part(mating.fixed).name;
    const std::vector<check::Play> plays = check::EffectiveClearance(problem, domain::MatingId(m));
    if (plays.empty()) {
      without_play +=
          fmt::format("no play of {} on {}: no shaft is in a hole there\n", held, fixed);
    }
    for (const check::Play& play : plays) {
      table.Add({fmt::format("{} with {}", held, fixed), DirectionText(play.axis),
                 fmt::format("{:.3f}", 1000 * play.nominal),
                 fmt::format("{:.3f}", 1000 * play.measured),
                 fmt::format("{:.1f}", 100 * play.RelativeDifference()),
                 Holds(play) ? "holds" : "violated"});
      json.push_back({{"held", held},
                      {"fixed", fixed},
                      {"axis", {play.axis.x(), play.axis.y(), play.axis.z()}},
                      {"nominal", play.nominal / 2},
                      {"effective", play.measured / 2},
                      {"holds", Holds(play)}});
      report.holds = report.holds && Holds(play);
    }
  }
  if (!json.empty()) report.text += fmt::format("\n{}", table.Text());
  if (!without_play.empty()) report.text += fmt::format("\n{}", without_play);
}

}  // namespace

Report ReportOn(const Problem& problem) {
  Draft report;
  report.text = fmt::format("scenario {}: {}\nworkcell {}, {}, {}\n\n", problem.name, problem.title,
                            problem.workcell->name(), Counted(std::ssize(problem.parts), "part"),
                            Counted(std::ssize(problem.goals), "goal"));
  report.json = {{"scenario", problem.name},
                 {"title", problem.title},
                 {"workcell", problem.workcell->name()},
                 {"goals", problem.goals.size()}};
  AddParts(problem, report);
  AddUnmovable(problem, report);
  AddStablePoses(problem, report);
  AddTolerances(problem, report);
  AddClearances(problem, report);
  return {std::move(report.text), std::make_shared<const Json>(std::move(report.json)),
          report.holds};
}

}  // namespace assay::cli
