#include "sim/cli/sweep_output/sweep_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "planner/base/counted.h"
#include "sim/cli/options/quantity.h"
#include "sim/cli/plan_output/table.h"
#include "sim/cli/trial_output/json_number.h"
#include "sim/cli/trial_output/verdict_tally.h"
#include "sim/scenario/scenario.h"
#include "sim/sweep/database/wilson.h"
#include "sim/sweep/grid/grid.h"

namespace assay::cli {
namespace {

using Json = nlohmann::ordered_json;
using sweep::CellRecord;
using sweep::CellSummary;

// A column that distinguishes cells. It is shown if its values differ.
struct Axis {
  const char* name;
  std::string (*value)(const CellRecord&);
};

constexpr std::array kAxes = {
    Axis{"scenario", [](const CellRecord& cell) { return cell.scenario; }},
    Axis{"clearance mm",
         [](const CellRecord& cell) { return fmt::format("{:.6g}", 1000 * cell.clearance); }},
    Axis{"errors", [](const CellRecord& cell) { return fmt::format("x {}", cell.error_scale); }},
    Axis{"propagation", [](const CellRecord& cell) { return cell.propagation; }},
    Axis{"resolvers", [](const CellRecord& cell) { return cell.resolvers; }},
    Axis{"grasp", [](const CellRecord& cell) { return cell.grasp; }},
    Axis{"sensing", [](const CellRecord& cell) { return cell.sensing; }},
    Axis{"noise", [](const CellRecord& cell) { return cell.noise; }},
    Axis{"seed", [](const CellRecord& cell) { return std::to_string(cell.seed); }},
};

std::vector<Axis> AxesShown(const std::vector<CellSummary>& cells) {
  std::vector<Axis> shown;
  for (const Axis& axis : kAxes) {
    std::set<std::string> values;
    for (const CellSummary& summary : cells) values.insert(axis.value(summary.cell));
    if (values.size() > 1) shown.push_back(axis);
  }
  return shown;
}

std::string PlanText(const CellRecord& cell) {
  if (cell.outcome == "none") return "no plan";
  if (cell.outcome == "budget") return "budget spent";
  if (cell.outcome == "untestable") {
    return fmt::format("{} actions, cannot be tested", cell.actions);
  }
  return fmt::format("{} actions, {}", cell.actions,
                     cell.proved ? "proved" : fmt::format("{} unproved", cell.errors));
}

bool IsFalsification(const CellSummary& summary) {
  return summary.cell.noise == sweep::Name(sweep::NoiseKind::kFalsification);
}

// Returns a cell's rate: "98.1 % [97.1, 98.8]". A falsification has no rate.
std::string RateText(const CellSummary& summary) {
  if (summary.done == 0 || IsFalsification(summary)) return "-";
  const Interval interval = sweep::WilsonInterval(summary.succeeded, summary.done);
  return fmt::format("{:.1f} % [{:.1f}, {:.1f}]", 100.0 * summary.succeeded / summary.done,
                     100 * interval.low, 100 * interval.high);
}

// A column that counts certificates or trials. Rare ones are shown if there are any.
struct CountColumn {
  const char* name;
  bool is_rare;
  std::int64_t (*count)(const CellSummary&);
};

constexpr std::array kCountColumns = {
    CountColumn{"contained", false, [](const CellSummary& s) { return s.certificates.contained; }},
    CountColumn{"inconclusive", true,
                [](const CellSummary& s) { return s.certificates.inconclusive; }},
    CountColumn{"violated", false, [](const CellSummary& s) { return s.certificates.violated; }},
    CountColumn{"not claimed", true,
                [](const CellSummary& s) { return s.certificates.not_claimed; }},
    CountColumn{"signalled", true,
                [](const CellSummary& s) { return std::int64_t{s.with_errors}; }},
    CountColumn{"recovered", true, [](const CellSummary& s) { return std::int64_t{s.recovered}; }},
    CountColumn{"operator", true,
                [](const CellSummary& s) { return std::int64_t{s.operator_called}; }},
};

std::vector<CountColumn> CountsShown(const std::vector<CellSummary>& cells) {
  std::vector<CountColumn> shown;
  std::ranges::copy_if(kCountColumns, std::back_inserter(shown), [&](const CountColumn& column) {
    return !column.is_rare || std::ranges::any_of(cells, [&](const CellSummary& summary) {
      return column.count(summary) != 0;
    });
  });
  return shown;
}

Table CellTable(const SweepResults& results) {
  const std::vector<Axis> axes = AxesShown(results.cells);
  const std::vector<CountColumn> counts = CountsShown(results.cells);
  std::vector<Table::Column> columns = {{"cell", Align::kRight}};
  for (const Axis& axis : axes) columns.push_back({axis.name});
  columns.push_back({"plan"});
  columns.push_back({"trials", Align::kRight});
  columns.push_back({"succeeded [95 %]", Align::kRight});
  for (const CountColumn& column : counts) columns.push_back({column.name, Align::kRight});
  Table table(std::move(columns));
  for (const CellSummary& summary : results.cells) {
    std::vector<std::string> row = {std::to_string(summary.cell.cell)};
    for (const Axis& axis : axes) row.push_back(axis.value(summary.cell));
    row.push_back(PlanText(summary.cell));
    row.push_back(fmt::format("{} of {}", summary.done, summary.cell.trials));
    row.push_back(RateText(summary));
    for (const CountColumn& column : counts) row.push_back(std::to_string(column.count(summary)));
    table.Add(std::move(row));
  }
  return table;
}

// Returns the numbers of failures by outcome: "not-seated: 3".
std::map<std::string, int> Failures(const SweepResults& results) {
  std::map<std::string, int> failures;
  for (const CellSummary& summary : results.cells) {
    for (const auto& [outcome, count] : summary.failed) failures[outcome] += count;
  }
  return failures;
}

std::string ReplayCommand(const SweepResults& results) {
  return fmt::format("assay replay {} {}", results.database, results.first_bad);
}

// Returns the command as a user types it, with the database's name.
std::string CommandOf(const std::string& replay, const std::string& database) {
  constexpr std::string_view kStored = "assay replay DB ";
  if (!replay.starts_with(kStored)) return replay;
  return fmt::format("assay replay {} {}", database, replay.substr(kStored.size()));
}

// Returns what the certificate says and what was observed: "y of peg: 1.2 mm is not in [-1, 1] mm".
std::string ViolationText(const sweep::CounterexampleRecord& example) {
  if (example.IsStatement()) {
    return fmt::format("the certificate says that the step {}, but it does not", example.name);
  }
  const Unit unit = ShownUnitOf(example.dimension);
  return fmt::format("{}: {} is not in [{:.6g}, {:.6g}] {}", example.name,
                     InUnit(example.observed, unit), example.low / unit.factor,
                     example.high / unit.factor, unit.name);
}

std::string CounterexampleText(const sweep::CounterexampleRecord& example,
                               const std::string& database) {
  return fmt::format("  {}: {}{}\n    to repeat it: {}\n", example.action, ViolationText(example),
                     example.replayed ? "" : " (seen only in an execution from a saved state)",
                     CommandOf(example.replay, database));
}

std::string FalsificationText(const CellFalsification& cell, const std::string& database) {
  const sweep::FalsificationRecord& falsification = cell.falsification;
  std::string text = fmt::format("cell {}: {} attempts, {} violated\n", cell.cell,
                                 falsification.attempts, falsification.certificates.violated);
  for (const sweep::CounterexampleRecord& example : falsification.counterexamples) {
    text += CounterexampleText(example, database);
  }
  for (const sweep::ConservatismRecord& ratio : falsification.conservatism) {
    text += fmt::format("  {}: guaranteed up to {:.3g} times the errors; {}\n", ratio.variable,
                        ratio.guaranteed,
                        ratio.broken ? fmt::format("a trial failed at {:.3g} times", *ratio.broken)
                                     : std::string("no trial failed"));
  }
  return text;
}

std::string FalsificationsText(const SweepResults& results) {
  if (results.falsifications.empty()) return "";
  std::string text = "\nattacks\n";
  for (const CellFalsification& cell : results.falsifications)
    text += FalsificationText(cell, results.database);
  return text;
}

std::string SpeedText(const sweep::RunRecord& run) {
  const sweep::Throughput& done = run.throughput;
  return fmt::format("{}, {} engine steps in {:.1f} s on {}: {:.0f} steps a second\n",
                     Counted(done.trials, "trial"), done.steps, done.seconds,
                     Counted(run.jobs, "thread"), done.StepsPerSecond());
}

Json RunJson(const sweep::RunRecord& run) {
  const sweep::Throughput& done = run.throughput;
  return {{"shard", run.shard},      {"jobs", run.jobs},
          {"trials", done.trials},   {"steps", done.steps},
          {"seconds", done.seconds}, {"steps_per_second", done.StepsPerSecond()}};
}

Json CounterexampleJson(const sweep::CounterexampleRecord& example, const std::string& database) {
  return {{"claim", example.claim},       {"action", example.action},
          {"name", example.name},         {"unit", domain::SiUnitOf(example.dimension).name},
          {"observed", example.observed}, {"low", OrNull(example.low)},
          {"high", OrNull(example.high)}, {"margin", example.margin},
          {"gate", example.gate},         {"noise", example.noise},
          {"steps", example.steps},       {"replayed", example.replayed},
          {"multiple", example.multiple}, {"replay", CommandOf(example.replay, database)}};
}

Json FalsificationJson(const CellFalsification& cell, const std::string& database) {
  const sweep::FalsificationRecord& falsification = cell.falsification;
  Json json = {{"cell", cell.cell},
               {"attempts", falsification.attempts},
               {"verdicts", ToJson(falsification.certificates)},
               {"claims", ToJson(falsification.claims)},
               {"counterexamples", Json::array()},
               {"conservatism", Json::array()}};
  for (const sweep::CounterexampleRecord& example : falsification.counterexamples) {
    json["counterexamples"].push_back(CounterexampleJson(example, database));
  }
  for (const sweep::ConservatismRecord& ratio : falsification.conservatism) {
    json["conservatism"].push_back({{"variable", ratio.variable},
                                    {"guaranteed", ratio.guaranteed},
                                    {"broken", OrNull(ratio.broken)},
                                    {"ratio", OrNull(ratio.ratio)}});
  }
  return json;
}

Json CellJson(const CellSummary& summary) {
  const CellRecord& cell = summary.cell;
  const Interval interval = sweep::WilsonInterval(summary.succeeded, summary.done);
  return {{"cell", cell.cell},
          {"scenario", cell.scenario},
          {"clearance", cell.clearance},
          {"error_scale", cell.error_scale},
          {"propagation", cell.propagation},
          {"resolvers", cell.resolvers},
          {"grasp", cell.grasp},
          {"sensing", cell.sensing},
          {"noise", cell.noise},
          {"seed", cell.seed},
          {"outcome", cell.outcome},
          {"actions", cell.actions},
          {"errors", cell.errors},
          {"trials", cell.trials},
          {"done", summary.done},
          {"succeeded", summary.succeeded},
          {"interval", {interval.low, interval.high}},
          {"failed", summary.failed},
          {"verdicts", ToJson(summary.certificates)},
          {"signalled", summary.with_errors},
          {"recovered", summary.recovered},
          {"operator_called", summary.operator_called}};
}

// Loads every scenario with every clearance and error scale, so that errors in them are reported.
void LoadAll(const sweep::Sweep& sweep, const domain::ModelPath& models) {
  for (const std::string& name : sweep.scenarios) {
    const std::filesystem::path file = sweep.PathOf(name);
    for (const std::optional<double>& clearance : sweep.clearances) {
      for (const double scale : sweep.error_scales) {
        scenario::Load(file, models, {.clearance = clearance, .error_scale = scale});
      }
    }
  }
}

}  // namespace

int SweepResults::Done() const {
  int done = 0;
  for (const CellSummary& summary : cells) done += summary.done;
  return done;
}

int SweepResults::Succeeded() const {
  int succeeded = 0;
  for (const CellSummary& summary : cells) succeeded += summary.succeeded;
  return succeeded;
}

check::VerdictCounts SweepResults::Certificates() const {
  check::VerdictCounts sum;
  for (const CellSummary& summary : cells) {
    sum += summary.certificates;
  }
  return sum;
}

SweepResults ResultsOf(const sweep::Store& store, const std::string& database) {
  SweepResults results = {.database = database,
                          .trials = store.TrialsInAll(),
                          .cells = sweep::Summarize(store),
                          .runs = store.Runs(),
                          .first_bad = static_cast<int>(store.database().Integer(
                              "SELECT coalesce(min(trial), 0) FROM trial"
                              " WHERE outcome != 'succeeded' OR violated > 0"))};
  std::erase_if(results.runs,
                [](const sweep::RunRecord& run) { return run.throughput.trials == 0; });
  for (const CellSummary& summary : results.cells) {
    std::optional<sweep::FalsificationRecord> falsification =
        store.FindFalsification(summary.cell.cell);
    if (falsification)
      results.falsifications.push_back({summary.cell.cell, *std::move(falsification)});
  }
  return results;
}

std::string ForPeople(const SweepResults& results) {
  std::string text = CellTable(results).Text() + FalsificationsText(results);
  const int done = results.Done();
  text +=
      fmt::format("\n{} of {} succeeded; {} violated\n", results.Succeeded(),
                  Counted(done, "trial"), Counted(results.Certificates().violated, "certificate"));
  for (const auto& [outcome, count] : Failures(results)) {
    text += fmt::format("{}: {}\n", outcome, count);
  }
  if (results.first_bad > 0) text += fmt::format("to repeat it: {}\n", ReplayCommand(results));
  for (const CellSummary& summary : results.cells) {
    if (summary.cell.conflict.empty()) continue;
    text += fmt::format("cell {}: {}\n", summary.cell.cell, summary.cell.conflict);
  }
  if (done < results.trials) {
    text += fmt::format("{} of {} trials are in the database\n", done, results.trials);
  }
  for (const sweep::RunRecord& run : results.runs) text += SpeedText(run);
  return text;
}

Json ToJson(const SweepResults& results) {
  const std::map<std::string, int> failures = Failures(results);
  Json json = {{"database", results.database}, {"trials", results.trials},
               {"done", results.Done()},       {"succeeded", results.Succeeded()},
               {"failed", failures},           {"verdicts", ToJson(results.Certificates())},
               {"replay", Json::array()},      {"cells", Json::array()},
               {"attacks", Json::array()},     {"runs", Json::array()}};
  if (results.first_bad > 0) json["replay"].push_back(ReplayCommand(results));
  for (const CellSummary& summary : results.cells) json["cells"].push_back(CellJson(summary));
  for (const CellFalsification& cell : results.falsifications) {
    json["attacks"].push_back(FalsificationJson(cell, results.database));
  }
  for (const sweep::RunRecord& run : results.runs) json["runs"].push_back(RunJson(run));
  return json;
}

ExitCode ExitCodeOf(const SweepResults& results) {
  if (results.first_bad > 0) return ExitCode::kFailed;
  const auto has = [&](const char* outcome) {
    return std::ranges::any_of(
        results.cells, [&](const CellSummary& summary) { return summary.cell.outcome == outcome; });
  };
  if (has("untestable")) return ExitCode::kFailed;
  if (has("none")) return ExitCode::kNoPlan;
  return has("budget") ? ExitCode::kBudgetSpent : ExitCode::kDone;
}

Report ReportOn(const sweep::Sweep& sweep, const domain::ModelPath& models) {
  LoadAll(sweep, models);
  const std::vector<sweep::Cell> cells = sweep::Cells(sweep);
  int plans = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    plans += i == 0 || !sweep::SharePlan(cells[i - 1], cells[i]);
  }
  const int trials = sweep::TrialCount(cells);
  const auto falsifications =
      std::ranges::count(cells, sweep::NoiseKind::kFalsification, &sweep::Cell::noise);
  Report report;
  report.text =
      fmt::format("sweep {}: {} in {}, {}\n", sweep.file.stem().string(), Counted(trials, "trial"),
                  Counted(std::ssize(cells), "cell"), Counted(plans, "plan"));
  if (falsifications > 0) {
    report.text += fmt::format("{} of the trials are falsifications with {} attempts each\n",
                               falsifications, sweep.attempts);
  }
  report.json = std::make_shared<const Json>(Json{{"sweep", sweep.file.stem().string()},
                                                  {"scenarios", sweep.scenarios},
                                                  {"trials", trials},
                                                  {"cells", cells.size()},
                                                  {"attacks", falsifications},
                                                  {"plans", plans}});
  return report;
}

}  // namespace assay::cli
