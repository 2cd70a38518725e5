#include "sim/cli/trial_output/trial_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "sim/cli/options/quantity.h"
#include "sim/cli/plan_output/table.h"

namespace assay::cli {
namespace {

using Json = nlohmann::ordered_json;
using domain::PartId;
using geometry::Vector3;

struct StepRow {
  const execution::StepEnd& end;
  double duration = 0;  // seconds
  Vector3 error;        // true minus believed position of the handled part, metres
};

std::vector<StepRow> StepRows(const domain::Problem& problem, const plan::Plan& plan,
                              const execution::Trace& trace) {
  std::vector<StepRow> rows;
  double start = 0;
  for (const execution::StepEnd* end : trace.All<execution::StepEnd>()) {
    const execution::TrueAndBelieved& part =
        end->snapshot.parts[HandledPart(problem, plan.step(end->step).action).index()];
    rows.push_back(
        {*end, end->snapshot.time - start, part.truth.translation() - part.believed.translation()});
    start = end->snapshot.time;
  }
  return rows;
}

std::string StepTable(const std::vector<StepRow>& rows) {
  Table table({{"step", Align::kRight},
               {"id"},
               {"action"},
               {"s", Align::kRight},
               {"true - believed, mm", Align::kRight},
               {"opening mm", Align::kRight}});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Vector3 mm = 1000 * rows[i].error;
    table.Add({std::to_string(i + 1), rows[i].end.name, rows[i].end.action,
               fmt::format("{:.2f}", rows[i].duration),
               fmt::format("{:+.3f} {:+.3f} {:+.3f}", mm.x(), mm.y(), mm.z()),
               fmt::format("{:.2f}", 1000 * rows[i].end.snapshot.opening)});
  }
  return table.Text();
}

// Returns the side of the limit on which a value must be. Every value must be below its limit,
// except the opening of a hand that has let go.
std::string_view Direction(const execution::Finding& finding) {
  return finding.aspect == execution::Aspect::kReleased ? ">=" : "<=";
}

std::string FindingTable(const std::vector<execution::Finding>& findings) {
  Table table(
      {{"goal"}, {"value", Align::kRight}, {"must be", Align::kRight}, {"unit"}, {"verdict"}});
  for (const execution::Finding& finding : findings) {
    const Unit unit = ShownUnitOf(finding.dimension);
    table.Add({finding.name, fmt::format("{:.4f}", finding.value / unit.factor),
               fmt::format("{} {:.4f}", Direction(finding), finding.limit / unit.factor),
               std::string(unit.name), finding.holds ? "holds" : "violated"});
  }
  return table.Text();
}

Json StepsToJson(const std::vector<StepRow>& rows) {
  Json json = Json::array();
  for (const StepRow& row : rows) {
    json.push_back({{"id", row.end.name},
                    {"action", row.end.action},
                    {"duration", row.duration},
                    {"error", {row.error.x(), row.error.y(), row.error.z()}},
                    {"opening", row.end.snapshot.opening}});
  }
  return json;
}

Json FindingsToJson(const std::vector<execution::Finding>& findings) {
  Json json = Json::array();
  for (const execution::Finding& finding : findings) {
    json.push_back({{"name", finding.name},
                    {"value", finding.value},
                    {"limit", finding.limit},
                    {"unit", domain::SiUnitOf(finding.dimension).name},
                    {"holds", finding.holds}});
  }
  return json;
}

}  // namespace

std::string ForPeople(const domain::Problem& problem, const plan::Plan& plan,
                      const check::Trial& trial) {
  return fmt::format("{}\n{}", StepTable(StepRows(problem, plan, trial.trace)),
                     FindingTable(trial.verdict.findings));
}

Json ToJson(const domain::Problem& problem, const plan::Plan& plan, const check::Trial& trial) {
  return {{"trial", trial.number},
          {"outcome", execution::Name(trial.verdict.outcome)},
          {"reason", trial.verdict.reason},
          {"simulated", trial.trace.end().snapshot.time},
          {"steps", StepsToJson(StepRows(problem, plan, trial.trace))},
          {"goals", FindingsToJson(trial.verdict.findings)}};
}

}  // namespace assay::cli
