#include "sim/report/findings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "sim/report/observations.h"

namespace assay::report {
namespace {

using nlohmann::json;
using sweep::CellRecord;
using sweep::Database;
using sweep::Statement;

bool HasTable(const Database& database, std::string_view table) {
  Statement row =
      database.Prepare("SELECT count(*) FROM sqlite_schema WHERE type = 'table' AND name = ?");
  row.Bind(table);
  return row.Next() && row.Int(0) != 0;
}

// "assemble(peg, block)"
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

// What the plan says that its steps are, by their names. A plan that does not
// tell leaves them out.
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

std::vector<AttackedClaim> ReadWorst(const Database& database, int cell) {
  Statement rows = database.Prepare(
      "SELECT claim, step, action, about, name, unit, observed, low, high, margin, gate, verdict, "
      "phase, attempt, noise FROM attack_worst WHERE cell = ? ORDER BY step, claim");
  rows.Bind(cell);
  std::vector<AttackedClaim> worst;
  while (rows.Next()) {
    worst.push_back({.claim = rows.Text(0),
                     .step = rows.Int(1),
                     .action = rows.Text(2),
                     .about = rows.Text(3),
                     .name = rows.Text(4),
                     .unit = rows.Text(5),
                     .observed = rows.Real(6),
                     .low = rows.Real(7),
                     .high = rows.Real(8),
                     .margin = rows.Real(9),
                     .gate = rows.Real(10),
                     .verdict = rows.Text(11),
                     .phase = rows.Text(12),
                     .attempt = rows.Integer(13),
                     .noise = rows.Text(14)});
  }
  return worst;
}

std::vector<Counterexample> ReadCounterexamples(const Database& database, int cell) {
  Statement rows = database.Prepare(
      "SELECT number, claim, action, name, unit, observed, low, high, margin, gate, noise, steps, "
      "replayed, multiple, replay FROM counterexample WHERE cell = ? ORDER BY number");
  rows.Bind(cell);
  std::vector<Counterexample> examples;
  while (rows.Next()) {
    examples.push_back({.number = rows.Int(0),
                        .claim = rows.Text(1),
                        .action = rows.Text(2),
                        .name = rows.Text(3),
                        .unit = rows.Text(4),
                        .observed = rows.Real(5),
                        .low = rows.Real(6),
                        .high = rows.Real(7),
                        .margin = rows.Real(8),
                        .gate = rows.Real(9),
                        .noise = rows.Text(10),
                        .steps = rows.Int(11),
                        .replayed = rows.Int(12) != 0,
                        .multiple = rows.Real(13),
                        .replay = rows.Text(14)});
  }
  return examples;
}

std::optional<AttackFindings> ReadAttack(const Database& database, int cell) {
  if (!HasTable(database, "attack")) return std::nullopt;
  Statement row = database.Prepare(
      "SELECT attempts, contained, inconclusive, violated, not_claimed, claims_contained, "
      "claims_inconclusive, claims_violated, claims_not_claimed FROM attack WHERE cell = ?");
  row.Bind(cell);
  if (!row.Next()) return std::nullopt;
  AttackFindings attack{
      .attempts = row.Integer(0),
      .certificates = {row.Integer(1), row.Integer(2), row.Integer(3), row.Integer(4)},
      .claims = {row.Integer(5), row.Integer(6), row.Integer(7), row.Integer(8)}};
  if (HasTable(database, "attack_worst")) attack.worst = ReadWorst(database, cell);
  if (HasTable(database, "counterexample")) {
    attack.counterexamples = ReadCounterexamples(database, cell);
  }
  return attack;
}

std::vector<Conservatism> ReadConservatism(const Database& database, int cell) {
  std::vector<Conservatism> rows_read;
  if (!HasTable(database, "conservatism")) return rows_read;
  Statement rows = database.Prepare(
      "SELECT variable, guaranteed, broken, ratio FROM conservatism WHERE cell = ? ORDER BY "
      "variable <> 'all', variable");
  rows.Bind(cell);
  while (rows.Next()) {
    rows_read.push_back({rows.Text(0), rows.Real(1), rows.Real(2), rows.Real(3)});
  }
  return rows_read;
}

// Whether two cells differ in nothing but the noise that the trials are done
// under.
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
  const Database& database = store.database();
  const json plan = json::parse(summary.cell.plan, nullptr, false);
  const int number = summary.cell.cell;
  CellFindings cell{.summary = std::move(summary),
                    .recovery = {},
                    .steps = ReadSteps(store, number),
                    .attack = ReadAttack(database, number),
                    .conservatism = ReadConservatism(database, number)};
  cell.recovery = ReadRecovery(database, cell.cell(), plan);
  const std::map<std::string, std::string> actions = ActionsOf(plan);
  for (StepFindings& step : cell.steps) {
    if (const auto found = actions.find(step.action); found != actions.end()) {
      step.what = found->second;
    }
  }
  return cell;
}

}  // namespace

VerdictCounts StepFindings::ObservedClaims() const {
  VerdictCounts sum;
  for (const ClaimFindings& claim : claims) sum += claim.observed.verdicts;
  return sum;
}

int Findings::trials() const {
  const auto found = facts.find("trials");
  return found == facts.end() ? done() : std::atoi(found->second.c_str());
}

int Findings::done() const {
  int count = 0;
  for (const CellFindings& cell : cells) count += cell.summary.done;
  return count;
}

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
  Statement planning = store.database().Prepare("SELECT total(seconds) FROM planning");
  if (planning.Next()) findings.planning_seconds = planning.Real(0);
  return findings;
}

}  // namespace assay::report
