#include "sim/report/findings/read_findings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "sim/report/findings/observations.h"

namespace assay::report {
namespace {

using nlohmann::json;
using sweep::CellRecord;
using sweep::Database;
using sweep::Statement;

// Returns the text of an action, like "assemble(peg, block)".
std::string ActionText(const json& action) {
  const json arguments = action.value("arguments", json::object());
  std::vector<std::string> parts;
  for (const char* key : {"part", "held", "fixed"}) {
    if (arguments.contains(key) && arguments[key].is_string()) {
      parts.push_back(arguments[key].get<std::string>());
    }
  }
  return fmt::format("{}({})", action.value("name", "action"), fmt::join(parts, ", "));
}

// Returns the actions of a plan by the names of its steps. Steps whose action the plan does not
// name are left out.
std::map<std::string, std::string> ActionsOf(const json& plan) {
  std::map<std::string, std::string> actions;
  if (!plan.is_object()) return actions;
  for (const json& action : plan.value("actions", json::array())) {
    if (!action.is_object() || !action.contains("id") || !action["id"].is_string()) continue;
    actions[action["id"].get<std::string>()] = ActionText(action);
  }
  return actions;
}

RecoveryFindings ReadRecovery(const Database& database, const CellRecord& cell, const json& plan) {
  Statement row = database.Prepare(
      "SELECT total(errors_signalled), total(recovered), total(errors_signalled = 0 AND outcome = "
      "'succeeded') FROM trial WHERE cell = ?");
  row.Bind(cell.cell);
  RecoveryFindings recovery;
  if (row.Next()) {
    recovery = {.signalled = row.Int(0), .mended = row.Int(1), .unaided = row.Int(2)};
  }
  recovery.verifies =
      recovery.signalled > 0 ||
      (plan.is_object() && plan.contains("verifications") && !plan["verifications"].empty());
  return recovery;
}

std::optional<sweep::FalsificationRecord> ReadFalsification(const sweep::Store& store, int cell) {
  std::optional<sweep::FalsificationRecord> falsification = store.FindFalsification(cell);
  if (!falsification) return falsification;
  std::ranges::stable_sort(falsification->worst, {}, &sweep::WorstClaimRecord::step);
  std::ranges::stable_partition(
      falsification->conservatism,
      [](const sweep::ConservatismRecord& ratio) { return ratio.variable == "all"; });
  return falsification;
}

int FalsificationTrial(const Database& database, int cell) {
  Statement row = database.Prepare("SELECT trial FROM trial WHERE cell = ?");
  row.Bind(cell);
  return row.Next() ? row.Int(0) : 0;
}

// Returns whether two cells differ only in the noise of their trials.
bool SamePlan(const CellRecord& a, const CellRecord& b) {
  return a.scenario == b.scenario && a.clearance == b.clearance && a.error_scale == b.error_scale &&
         a.propagation == b.propagation && a.resolvers == b.resolvers && a.sensing == b.sensing &&
         a.grasp == b.grasp;
}

void AddControls(std::vector<CellFindings>& cells) {
  for (CellFindings& cell : cells) {
    if (cell.is_control()) continue;
    for (const CellFindings& control : cells) {
      if (!control.is_control() || !SamePlan(cell.cell(), control.cell())) continue;
      cell.control_done += control.summary.done;
      cell.control_succeeded += control.summary.succeeded;
    }
  }
}

CellFindings ReadCell(const sweep::Store& store, sweep::CellSummary summary) {
  const json plan = json::parse(summary.cell.plan, nullptr, false);
  const int number = summary.cell.cell;
  CellFindings cell{.summary = std::move(summary),
                    .recovery = {},
                    .steps = ReadSteps(store, number),
                    .falsification = ReadFalsification(store, number)};
  if (cell.falsification) cell.falsification_trial = FalsificationTrial(store.database(), number);
  cell.recovery = ReadRecovery(store.database(), cell.cell(), plan);
  const std::map<std::string, std::string> actions = ActionsOf(plan);
  for (StepFindings& step : cell.steps) {
    if (const auto found = actions.find(step.action); found != actions.end()) {
      step.what = found->second;
    }
  }
  return cell;
}

void ReadFailures(const Database& database, Findings& findings) {
  constexpr std::int64_t kMostFailures = 100;
  Statement row = database.Prepare(
      "SELECT trial, cell, trial.outcome, reason, trial.violated FROM trial JOIN cell USING(cell) "
      "WHERE (trial.outcome <> 'succeeded' OR trial.violated > 0) AND cell.noise <> 'attack' ORDER "
      "BY trial");
  while (row.Next()) {
    if (++findings.failures_in_all > kMostFailures) continue;
    const bool is_violated = row.Int(4) > 0;
    const std::string outcome = row.Text(2);
    findings.failures.push_back({row.Int(0), row.Int(1),
                                 is_violated ? outcome + ", a certificate violated" : outcome,
                                 row.Text(3)});
  }
}

}  // namespace

Findings ReadFindings(const sweep::Store& store, const std::string& database) {
  Findings findings{.database = database,
                    .facts = store.Facts(),
                    .runs = store.Runs(),
                    .cells = {},
                    .mean_trial_seconds = store.MeanSeconds(),
                    .notable = FindNotable(store)};
  for (sweep::CellSummary& summary : sweep::Summarize(store)) {
    findings.cells.push_back(ReadCell(store, std::move(summary)));
  }
  AddControls(findings.cells);
  ReadFailures(store.database(), findings);
  Statement planning = store.database().Prepare("SELECT total(seconds) FROM planning");
  if (planning.Next()) findings.planning_seconds = planning.Real(0);
  return findings;
}

}  // namespace assay::report
