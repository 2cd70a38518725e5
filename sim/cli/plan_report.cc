#include "sim/cli/plan_report.h"

#include <fmt/format.h>

#include "sim/cli/plan_text.h"
#include "sim/cli/planned_problem.h"

namespace assay::cli {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

Json ToJson(const plan::Plan& plan, const plan::CheckReport& report) {
  Json flaws = Json::array();
  for (const plan::Flaw& flaw : report.flaws) {
    flaws.push_back({{"step", flaw.step.IsNone() ? Json() : Json(plan.step(flaw.step).name)},
                     {"what", flaw.what}});
  }
  return {{"flaws", flaws}, {"orders", report.linearizations}, {"all_orders", report.all_orders}};
}

Report ReportOn(const domain::Problem& problem, const plan::PlanResult& result) {
  Report report;
  report.text = fmt::format("plan for {}\n{}", problem.name, Text(problem, result));
  report.json = {{"plan", problem.name}};
  if (result.outcome != Outcome::kFound) return report;
  const plan::CheckReport check = CheckPlan(problem, result.plan);
  report.text += Text(result.plan, check);
  report.json["check"] = ToJson(result.plan, check);
  report.holds = check.flaws.empty();
  return report;
}

}  // namespace assay::cli
