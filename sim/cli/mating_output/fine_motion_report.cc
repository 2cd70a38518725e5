#include "sim/cli/mating_output/fine_motion_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "sim/cli/plan_output/table.h"

namespace assay::cli {
namespace {

using Json = nlohmann::ordered_json;
using finemotion::FineMotionPlan;

std::string UnwantedText(const finemotion::Unwanted& unwanted) {
  return fmt::format("{}{} at {:.3g} times the errors", unwanted.is_loss ? "loss of " : "",
                     finemotion::Name(unwanted.contact), unwanted.scale);
}

Json UnwantedJson(const finemotion::Unwanted& unwanted) {
  return {{"contact", finemotion::Name(unwanted.contact)},
          {"loss", unwanted.is_loss},
          {"scale", unwanted.scale}};
}

Json StrategyJson(const FineMotionPlan& plan) {
  Json motions = Json::array();
  for (const finemotion::CertainMotion& motion : plan.motions) {
    const Eigen::VectorXd& d = motion.command.displacement;
    Json until;
    if (motion.command.until) {
      until = {{"contact", finemotion::Name(*motion.command.until)},
               {"longest", motion.check.longest}};
    }
    motions.push_back({{"state", NamesOf(motion.command.kept)},
                       {"velocity", std::vector<double>(d.begin(), d.begin() + 6)},
                       {"until", until}});
  }
  return motions;
}

Json MarginsJson(const FineMotionPlan& plan) {
  Json margins = Json::array();
  int number = 0;
  for (const finemotion::CertainMotion& motion : plan.motions) {
    ++number;
    for (const finemotion::Unwanted& unwanted : motion.check.unwanted) {
      Json margin = {{"motion", number}};
      margin.update(UnwantedJson(unwanted));
      margins.push_back(std::move(margin));
    }
  }
  return margins;
}

// Returns what stands in the way of a strategy, and how much was searched.
std::string WhyNone(const FineMotionPlan& plan, const finemotion::StrategyOptions& search) {
  const std::string in_the_way =
      plan.obstacle ? "; this is prevented by " + UnwantedText(*plan.obstacle) : "";
  const std::string looked =
      plan.outcome == Outcome::kNone
          ? fmt::format("all sequences of the planner's maneuvers from {} starts were tried",
                        search.starts)
          : fmt::format(
                "{} nodes for each critical point were not enough to try all sequences; --nodes "
                "raises this limit",
                search.thorough_nodes);
  return fmt::format("{}\n{}\n", in_the_way, looked);
}

}  // namespace

std::vector<std::string> NamesOf(std::span<const finemotion::ContactKey> keys) {
  std::vector<std::string> names;
  for (const finemotion::ContactKey& key : keys) names.push_back(finemotion::Name(key));
  return names;
}

std::string SummaryOf(const finemotion::MatingGeometry& geometry, const FineMotionPlan& plan) {
  return fmt::format(
      "{} critical points; {} motions, certain for {:.2f} times the errors and for friction up to "
      "{:.2f}; {} replays in exact geometry went as planned",
      geometry.critical_points.size(), plan.motions.size(), plan.absorbed, plan.friction_limit,
      plan.exact_replays);
}

std::vector<report::MatingSubject::Motion> MotionsOf(const FineMotionPlan& plan) {
  std::vector<report::MatingSubject::Motion> motions;
  for (const finemotion::CertainMotion& motion : plan.motions) {
    const auto& unwanted = motion.check.unwanted;
    motions.push_back(
        {.ends_with = motion.command.until ? finemotion::Name(*motion.command.until)
                                           : "the end of its planned length",
         .contacts = fmt::format("{}", fmt::join(NamesOf(motion.check.after.kept), ", ")),
         .unwanted = unwanted.empty() ? "none" : UnwantedText(unwanted.front())});
  }
  return motions;
}

std::string TextOf(const finemotion::MatingGeometry& geometry, const FineMotionPlan& plan,
                   const finemotion::StrategyOptions& search) {
  if (plan.motions.empty()) {
    return fmt::format("{} critical points; no sequence of contacts was found{}",
                       geometry.critical_points.size(), WhyNone(plan, search));
  }
  Table table({{""}, {"ends with"}, {"in contact at its end"}, {"first unwanted contact"}});
  int number = 0;
  for (const auto& motion : MotionsOf(plan)) {
    table.Add({fmt::format("{}", ++number), motion.ends_with, motion.contacts, motion.unwanted});
  }
  std::string text = fmt::format("{}\n{}", SummaryOf(geometry, plan), table.Text());
  const finemotion::TestComparison& comparison = plan.comparison;
  if (comparison.compared > 0) {
    text += fmt::format(
        "{} tests of intersections: the edge test was compared in {} of them, and misses {}\n",
        comparison.tests, comparison.compared, comparison.missed);
  }
  if (!plan.found())
    text += "no strategy was found that absorbs the errors" + WhyNone(plan, search);
  return text;
}

Json ToJson(const finemotion::MatingGeometry& geometry, const FineMotionPlan& plan) {
  Json critical_points = Json::array();
  for (const auto& point : geometry.critical_points) critical_points.push_back(point.travel);
  Json json = {{"outcome", Name(plan.outcome, "plan")},
               {"critical_points", critical_points},
               {"absorbed", plan.absorbed},
               {"exact_replays", plan.exact_replays},
               {"friction", plan.friction_limit},
               {"intersections",
                {{"tests", plan.comparison.tests},
                 {"compared", plan.comparison.compared},
                 {"missed", plan.comparison.missed}}},
               {"strategy", StrategyJson(plan)},
               {"margins", MarginsJson(plan)}};
  if (!plan.found() && plan.obstacle) json["obstacle"] = UnwantedJson(*plan.obstacle);
  return json;
}

std::string TextOf(const MatingTask& task, const assembly::Unreached& unreached) {
  const std::string where = unreached.motion == 0
                                ? "where the strategy starts"
                                : fmt::format("where motion {} ends", unreached.motion);
  const std::string why = unreached.obstacle.IsNone()
                              ? "the arm does not reach this place"
                              : fmt::format("the hand would go through '{}'",
                                            task.planned.problem.part(unreached.obstacle).name);
  return fmt::format(
      "the arm cannot execute the strategy with any grasp; with {}, {}, the tool at {}: {}\n",
      task.assemble.hold.grasp, where, plan::InMillimetres(unreached.X_WorldTool.translation()),
      why);
}

Json ToJson(const MatingTask& task, const assembly::Unreached& unreached) {
  const geometry::Vector3 at = unreached.X_WorldTool.translation();
  const auto& problem = task.planned.problem;
  return {{"motion", unreached.motion},
          {"tool", {at.x(), at.y(), at.z()}},
          {"obstacle",
           unreached.obstacle.IsNone() ? Json() : Json(problem.part(unreached.obstacle).name)}};
}

}  // namespace assay::cli
