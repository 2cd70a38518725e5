#include "sim/cli/plan_output/plan_text.h"

#include <fmt/format.h>

#include "sim/cli/plan_output/certificate_text.h"
#include "sim/cli/plan_output/table.h"

namespace assay::cli {
namespace {

using domain::Problem;

// Returns the paths that the arm takes where it cannot go up, over and down; empty if it always
// can.
std::string TravelText(const plan::Plan& plan) {
  std::string text;
  const auto tell = [&](const std::string& to, const plan::Travel& travel) {
    if (travel.is_usual) return;
    text += fmt::format("  to {}: {} postures, {:.1f} mm clear\n", to, travel.path.size(),
                        1e3 * travel.clearance);
  };
  for (const plan::StepId id : plan.ExecutionOrder()) {
    const plan::PlannedStep& step = plan.step(id);
    if (step.travel) tell(fmt::format("step {}", step.executed), *step.travel);
  }
  if (plan.homing) tell("home", *plan.homing);
  return text.empty() ? text : "\npaths around obstacles\n" + text;
}

constexpr const char* kSpentBudget =
    "The budget was spent before there was an answer. --budget sets a greater budget.\n";

// Returns whether the planner's limits left it anything to search.
bool HasSearched(const plan::PlanResult& result) {
  const auto least = result.counters.find("least_actions");
  return least != result.counters.end() && least->second >= 0;
}

// Returns a heading and a line for each item, or nothing if there are no items.
std::string Listed(const std::string& heading, const std::vector<std::string>& items) {
  if (items.empty()) return "";
  return fmt::format("{}:\n  - {}\n", heading, fmt::join(items, "\n  - "));
}

}  // namespace

std::string PlanTable(const Problem& problem, const plan::Plan& plan) {
  const bool is_certified = !UncertaintyText(problem, plan).empty();
  std::vector<Table::Column> columns = {
      {"executed", Align::kRight}, {"inserted", Align::kRight}, {"id"}, {"action"}};
  if (is_certified) columns.push_back({"certificate"});
  Table table(std::move(columns));
  for (const plan::StepId id : plan.ExecutionOrder()) {
    const plan::PlannedStep& step = plan.step(id);
    std::vector<std::string> row = {std::to_string(step.executed), std::to_string(step.inserted),
                                    step.name, FullText(problem, step.action)};
    if (is_certified) row.push_back(CertificateText(step));
    table.Add(std::move(row));
  }
  return table.Text();
}

std::string Text(const Problem& problem, const plan::PlanResult& result) {
  switch (result.outcome) {
    case Outcome::kFound:
      if (result.plan.steps.empty()) {
        return "The goal holds already at the believed poses: nothing is to be done.\n"
               "Nothing is proved about errors of these poses.\n";
      }
      return PlanTable(problem, result.plan) + TravelText(result.plan) +
             UncertaintyText(problem, result.plan);
    case Outcome::kNone:
      return (result.hypotheses.empty()
                  ? "No plan exists.\n"
                  : Listed("No plan exists under these hypotheses", result.hypotheses)) +
             Listed("These conditions cannot hold together", TextsOf(result.conflict)) +
             Listed("The nearest misses", TextsOf(result.near_misses));
    case Outcome::kBudget:
      if (result.obstruction) {
        return fmt::format("The arm can execute no plan that was found: {}.\n",
                           result.obstruction->text);
      }
      if (!result.limits.empty()) {
        return Listed(
                   "No plan was found, and it is not proved that none exists. A plan may exist "
                   "beyond these limits of the planner",
                   result.limits) +
               (HasSearched(result) ? kSpentBudget : "");
      }
      return kSpentBudget;
  }
  return "";
}

std::string TextOfFlawed(const Problem& problem, const plan::PlanResult& result) {
  if (result.plan.steps.empty()) return "";
  plan::Plan actions = result.plan;
  for (plan::PlannedStep& step : actions.steps) step.certificate = {};
  return PlanTable(problem, actions);
}

std::string Text(const plan::Plan& plan, const plan::CheckReport& report) {
  if (report.flaws.empty()) {
    if (report.linearizations == 0) return "";  // there is no plan
    return fmt::format("no flaws in {}{}\n",
                       report.linearizations == 1
                           ? "1 order of the steps"
                           : fmt::format("{} orders of the steps", report.linearizations),
                       report.all_orders ? " (all there are)" : " (there are more)");
  }
  std::string text = fmt::format("flaws: {}\n", report.flaws.size());
  for (const plan::Flaw& flaw : report.flaws) {
    const std::string where = flaw.step.IsNone() ? "plan" : plan.step(flaw.step).name;
    const std::string place = flaw.place.line == 0 ? "" : flaw.place.Text() + ": ";
    text += fmt::format("  {}{}: {}\n", place, where, flaw.what);
  }
  return text;
}

}  // namespace assay::cli
