#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "planner/domain/workcell/model_path.h"
#include "sim/cli/plans/report.h"
#include "sim/cli/program/exit_code.h"
#include "sim/sweep/run/sweep_file.h"
#include "sim/sweep/store/store.h"
#include "sim/sweep/store/summary.h"

namespace assay::cli {

// An attack in the database of a sweep.
struct CellAttack {
  int cell = 0;
  sweep::AttackRecord attack;
};

// What is in the database of a sweep.
struct SweepResults {
  std::string database;  // path, as the user gave it
  int trials = 0;        // of the whole sweep
  std::vector<sweep::CellSummary> cells = {};
  std::vector<CellAttack> attacks = {};     // in the order of the cells
  std::vector<sweep::RunRecord> runs = {};  // that did trials other than attacks, to their end
  int first_bad = 0;  // the first trial that failed or violated a prediction; 0: there is none

  int Done() const;
  int Succeeded() const;
  check::VerdictCounts Certificates() const;
};
SweepResults ResultsOf(const sweep::Store& store, const std::string& database);

// Rates of success with their 95 % intervals and counts of verdicts, for each cell; attacks with
// their counterexamples; how fast it went.
std::string ForPeople(const SweepResults& results);
// sweep.schema.json.
nlohmann::ordered_json ToJson(const SweepResults& results);

// Failed if a trial failed, a prediction was violated or a plan cannot be tested; no plan if a cell
// has none; else done.
ExitCode ExitCodeOf(const SweepResults& results);

// What a sweep file comes to: its grid. Throws InputError if a scenario of it is wrong.
Report ReportOn(const sweep::Sweep& sweep, const domain::ModelPath& models);

}  // namespace assay::cli
