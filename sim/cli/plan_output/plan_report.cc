#include "sim/cli/plan_output/plan_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "sim/cli/plan_output/plan_text.h"

namespace assay::cli {

using Json = nlohmann::ordered_json;

Json ToJson(const plan::Plan& plan, const plan::CheckReport& report) {
  Json flaws = Json::array();
  for (const plan::Flaw& flaw : report.flaws) {
    Json told = {{"step", flaw.step.IsNone() ? Json() : Json(plan.step(flaw.step).name)},
                 {"what", flaw.what}};
    if (flaw.place.line > 0) {
      told["line"] = flaw.place.line;
      told["column"] = flaw.place.column;
    }
    flaws.push_back(std::move(told));
  }
  return {{"flaws", flaws}, {"orders", report.linearizations}, {"all_orders", report.all_orders}};
}

Report ReportOn(const PlannedProblem& planned) {
  const domain::Problem& problem = planned.problem;
  const plan::PlanResult& result = planned.result;
  const plan::CheckReport check = CheckPlan(planned);
  Report report;
  report.holds = check.flaws.empty();
  report.text = fmt::format("plan for {}\n{}{}", problem.name,
                            report.holds ? Text(problem, result) : TextOfFlawed(problem, result),
                            Text(result.plan, check));
  Json json = {{"plan", problem.name}, {"check", ToJson(result.plan, check)}};
  report.json = std::make_shared<const Json>(std::move(json));
  return report;
}

}  // namespace assay::cli
