#include "sim/sweep/database/store.h"

#include <fmt/format.h>

#include <tuple>

#include "planner/base/input_files/input_file.h"
#include "sim/sweep/database/row.h"
#include "sim/sweep/database/schema.h"
#include "sim/sweep/grid/grid.h"

namespace assay::sweep {
namespace {

namespace fs = std::filesystem;

bool IsEmptyOrMissing(const fs::path& file) {
  std::error_code error;
  const auto size = fs::file_size(file, error);
  return error ? !fs::exists(file, error) : size == 0;
}

// Returns whether the database has no tables, which a killed program may have left.
bool HasNothing(const Database& database) {
  return database.Integer("SELECT count(*) FROM sqlite_schema") == 0 &&
         database.Integer("PRAGMA application_id") == 0;
}

check::NoiseFloor ReadGate(const Database& database, int cell) {
  check::NoiseFloor gate;
  Statement rows = database.Prepare("SELECT * FROM gate WHERE cell = ? ORDER BY id");
  rows.Bind(cell);
  while (rows.Next()) {
    gate.steps.push_back(ReadRow<check::StepNoiseFloor>(rows, 2));
    gate.steps.back().components = ReadRows<check::ClaimNoiseFloor>(
        database, "gate_component WHERE cell = ? AND id = ? ORDER BY component", 3, cell,
        rows.Int(1));
  }
  return gate;
}

// Returns in words what differs.
std::string Difference(const std::string& key) {
  if (key == "text") return "the sweep file has changed";
  if (key == "version") return "another version of the program made it";
  if (key.starts_with("scenario ")) return fmt::format("{} has changed", key);
  return fmt::format("its {} differs", key);
}

}  // namespace

// The statements that write cells and trials, each prepared once.
struct Store::Writing {
  explicit Writing(const Database& database)
      : trial(Insertion(database, "trial")),
        verdict(Insertion(database, "verdict")),
        claim(Insertion(database, "claim", kWidenClaim)),
        observation(Insertion(database, "observation")),
        timing(Insertion(database, "timing")),
        cell(Insertion(database, "cell")),
        gate(Insertion(database, "gate")),
        component(Insertion(database, "gate_component")),
        planning(Insertion(database, "planning")),
        falsification(Insertion(database, "attack")),
        worst(Insertion(database, "attack_worst")),
        counterexample(Insertion(database, "counterexample")),
        conservatism(Insertion(database, "conservatism")) {}

  Statement trial, verdict, claim, observation, timing, cell, gate, component, planning;
  Statement falsification, worst, counterexample, conservatism;
};

SweepFacts FactsOf(const Sweep& sweep, const std::string& version) {
  SweepFacts facts = {{"format", "assay-sweep/1"},
                      {"path", sweep.file.generic_string()},
                      {"text", sweep.text},
                      {"version", version},
                      {"trials", std::to_string(TrialCount(Cells(sweep)))}};
  for (const std::string& scenario : sweep.scenarios) {
    facts["scenario " + scenario] = ReadInput(sweep.PathOf(scenario), "a scenario file");
  }
  return facts;
}

Store::Store(const fs::path& file, Database::Access access)
    : database_(std::make_unique<Database>(file, access)) {
  if (access == Database::Access::kWrite) {
    // With these settings the log is on the disk before a commit returns, and readers do not wait
    // for the writer.
    database_->Execute(
        "PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; PRAGMA foreign_keys = ON");
  }
}

Store Store::Create(const fs::path& file, const SweepFacts& facts) {
  if (!IsEmptyOrMissing(file)) {
    throw InputError({.file = file.string()}, "there is something in this file already",
                     "the name of a new file, or --resume to go on with a sweep");
  }
  return Resume(file, facts);
}

Store Store::Resume(const fs::path& file, const SweepFacts& facts) {
  Store store(file, Database::Access::kWrite);
  if (HasNothing(*store.database_)) {
    store.Initialize(facts);
  } else {
    RequireSchema(*store.database_);
    store.RequireSameSweep(facts);
  }
  store.writing_ = std::make_shared<Writing>(*store.database_);
  return store;
}

Store Store::Open(const fs::path& file) {
  if (IsEmptyOrMissing(file)) {
    throw InputError({.file = file.string()},
                     fs::exists(file) ? "there is no database in it" : "there is no such file",
                     "a database that assay sweep has written");
  }
  Store store(file, Database::Access::kRead);
  RequireSchema(*store.database_);
  return store;
}

void Store::Initialize(const SweepFacts& facts) {
  Transaction transaction(*database_);
  MakeTables(*database_);
  Statement insert = database_->Prepare("INSERT INTO sweep VALUES(?,?)");
  for (const auto& [key, value] : facts) insert.Bind(key, value).Run();
  transaction.Commit();
}

void Store::RequireSameSweep(const SweepFacts& facts) const {
  const SweepFacts stored = Facts();
  for (const auto& [key, value] : facts) {
    // The path may differ, because several paths can lead to the same file.
    if (key == "path") continue;
    const auto found = stored.find(key);
    if (found != stored.end() && found->second == value) continue;
    throw InputError({.file = file().string()},
                     fmt::format("not a database of this sweep: {}", Difference(key)),
                     "a database of the same sweep, or a new file");
  }
}

void Store::Add(const RunRecord& run) {
  Statement insert = database_->Prepare("INSERT INTO run VALUES(NULL,?,?,?,?,?,?,?,?,?,?)");
  WriteRow(insert, std::tuple(), run);
}

void Store::Finish(const Throughput& throughput) {
  const auto& [trials, steps, seconds] = throughput;
  database_
      ->Prepare(
          "UPDATE run SET trials = ?, steps = ?, seconds = ?"
          " WHERE run = (SELECT max(run) FROM run)")
      .Bind(trials, steps, seconds)
      .Run();
}

void Store::Add(const std::vector<CellRecord>& cells, double seconds) {
  if (cells.empty()) return;
  Transaction transaction(*database_);
  for (const CellRecord& cell : cells) {
    WriteCell(cell);
    writing_->planning.Bind(cell.cell, seconds / static_cast<double>(cells.size())).Run();
  }
  transaction.Commit();
}

void Store::WriteCell(const CellRecord& cell) {
  WriteRow(writing_->cell, std::tuple(), cell);
  for (std::size_t id = 0; id < cell.gate.steps.size(); ++id) {
    WriteGate(cell.cell, static_cast<int>(id), cell.gate.steps[id]);
  }
}

void Store::WriteGate(int cell, int id, const check::StepNoiseFloor& gate) {
  WriteRow(writing_->gate, std::tuple(cell, id), gate);
  int number = 0;
  for (const check::ClaimNoiseFloor& component : gate.components) {
    WriteRow(writing_->component, std::tuple(cell, id, number++), component);
  }
}

void Store::Add(const std::vector<TimedTrial>& trials) {
  if (trials.empty()) return;
  Transaction transaction(*database_);
  for (const TimedTrial& trial : trials) WriteTrial(trial);
  transaction.Commit();
}

void Store::WriteTrial(const TimedTrial& timed) {
  const TrialRecord& trial = timed.record;
  WriteRow(writing_->trial, std::tuple(), trial, fmt::format("assay replay DB {}", trial.trial));
  WriteRows(writing_->claim, trial.cell, timed.claims);
  WriteRows(writing_->verdict, trial.trial, trial.verdicts);
  WriteRows(writing_->observation, trial.trial, trial.observations);
  if (timed.falsification) WriteFalsification(trial.cell, *timed.falsification);
  writing_->timing.Bind(trial.trial, timed.seconds).Run();
}

void Store::WriteFalsification(int cell, const FalsificationRecord& falsification) {
  WriteRow(writing_->falsification, std::tuple(cell), falsification);
  WriteRows(writing_->worst, cell, falsification.worst);
  WriteRows(writing_->counterexample, cell, falsification.counterexamples);
  WriteRows(writing_->conservatism, cell, falsification.conservatism);
}

void Store::Close() {
  // This fails while another program reads. Then the log stays beside the file, which does no harm.
  try {
    writing_.reset();
    database_->Execute("PRAGMA journal_mode = DELETE");
  } catch (const EnvironmentError&) {
  }
  database_.reset();
}

SweepFacts Store::Facts() const {
  SweepFacts facts;
  Statement rows = database_->Prepare("SELECT key, value FROM sweep");
  while (rows.Next()) facts[rows.Text(0)] = rows.Text(1);
  return facts;
}

// The conversion cannot fail, because RequireSchema has checked the value.
int Store::TrialsInAll() const { return std::stoi(Facts().at("trials")); }

std::vector<RunRecord> Store::Runs() const {
  std::vector<RunRecord> runs;
  Statement rows = database_->Prepare("SELECT * FROM run ORDER BY run");
  while (rows.Next()) runs.push_back(ReadRow<RunRecord>(rows, 1));
  return runs;
}

std::vector<CellRecord> Store::Cells() const {
  std::vector<CellRecord> cells;
  Statement rows = database_->Prepare("SELECT * FROM cell ORDER BY cell");
  while (rows.Next()) {
    cells.push_back(ReadRow<CellRecord>(rows, 0));
    cells.back().gate = ReadGate(*database_, cells.back().cell);
  }
  return cells;
}

std::vector<ClaimRecord> Store::Claims(int cell) const {
  return ReadRows<ClaimRecord>(*database_, "claim WHERE cell = ? ORDER BY step, claim", 1, cell);
}

std::vector<int> Store::Trials() const {
  std::vector<int> trials;
  Statement rows = database_->Prepare("SELECT trial FROM trial ORDER BY trial");
  while (rows.Next()) trials.push_back(rows.Int(0));
  return trials;
}

std::optional<TrialRecord> Store::FindTrial(int trial) const {
  Statement row = database_->Prepare("SELECT * FROM trial WHERE trial = ?");
  row.Bind(trial);
  if (!row.Next()) return std::nullopt;
  auto record = ReadRow<TrialRecord>(row, 0);
  record.verdicts =
      ReadRows<VerdictRecord>(*database_, "verdict WHERE trial = ? ORDER BY step", 1, trial);
  record.observations = ReadRows<ObservationRecord>(
      *database_, "observation WHERE trial = ? ORDER BY claim", 1, trial);
  return record;
}

std::optional<FalsificationRecord> Store::FindFalsification(int cell) const {
  Statement row = database_->Prepare("SELECT * FROM attack WHERE cell = ?");
  row.Bind(cell);
  if (!row.Next()) return std::nullopt;
  auto record = ReadRow<FalsificationRecord>(row, 1);
  record.worst =
      ReadRows<WorstClaimRecord>(*database_, "attack_worst WHERE cell = ? ORDER BY claim", 1, cell);
  record.counterexamples = ReadRows<CounterexampleRecord>(
      *database_, "counterexample WHERE cell = ? ORDER BY number", 1, cell);
  record.conservatism = ReadRows<ConservatismRecord>(
      *database_, "conservatism WHERE cell = ? ORDER BY variable", 1, cell);
  return record;
}

double Store::MeanSeconds() const {
  Statement row = database_->Prepare(
      "SELECT coalesce(avg(seconds), 0) FROM timing JOIN trial USING(trial)"
      " WHERE cell NOT IN (SELECT cell FROM attack)");
  return row.Next() ? row.Real(0) : 0;
}

}  // namespace assay::sweep
