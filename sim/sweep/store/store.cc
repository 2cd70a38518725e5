#include "sim/sweep/store/store.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "planner/base/check.h"
#include "planner/base/document/input_file.h"
#include "sim/sweep/run/grid.h"
#include "sim/sweep/store/schema.h"

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

std::string NameOf(domain::Dimension dimension) {
  return std::string(domain::SiUnitOf(dimension).name);
}

std::string ReplayCommand(int trial) { return fmt::format("assay replay DB {}", trial); }

CellRecord ReadCell(const Statement& row) {
  return {.cell = row.Int(0),
          .scenario = row.Text(1),
          .clearance = row.Real(2),
          .error_scale = row.Real(3),
          .propagation = row.Text(4),
          .resolvers = row.Text(5),
          .noise = row.Text(6),
          .sensing = row.Text(7),
          .seed = row.Integer(8),
          .trials = row.Int(9),
          .grasp = row.Text(10),
          .outcome = row.Text(11),
          .actions = row.Int(12),
          .errors = row.Int(13),
          .proved = row.Int(14) != 0,
          .conflict = row.Text(15),
          .plan = row.Text(16)};
}

check::Claimed ReadClaimed(const std::string& name) {
  for (const auto about :
       {check::Claimed::kBefore, check::Claimed::kPrecondition, check::Claimed::kAfter}) {
    if (check::Name(about) == name) return about;
  }
  return check::Claimed::kAfter;
}

std::vector<check::ClaimNoiseFloor> ReadComponents(const Database& database, int cell, int id) {
  std::vector<check::ClaimNoiseFloor> components;
  Statement rows = database.Prepare(
      "SELECT about, name, offset, step_size FROM gate_component WHERE cell = ? AND id = ? "
      "ORDER BY component");
  rows.Bind(cell, id);
  while (rows.Next()) {
    components.push_back({ReadClaimed(rows.Text(0)), rows.Text(1), rows.Real(2), rows.Real(3)});
  }
  return components;
}

check::NoiseFloor ReadGate(const Database& database, int cell) {
  check::NoiseFloor gate;
  Statement rows = database.Prepare(
      "SELECT id, arm, penetration, lag, lag_turn FROM gate WHERE cell = ? ORDER BY id");
  rows.Bind(cell);
  while (rows.Next()) {
    gate.steps.push_back({ReadComponents(database, cell, rows.Int(0)), rows.Real(1), rows.Real(2),
                          rows.Real(3), rows.Real(4)});
  }
  return gate;
}

TrialRecord ReadTrial(const Statement& row) {
  return {.trial = row.Int(0),
          .cell = row.Int(1),
          .number = row.Int(2),
          .noise = row.Text(3),
          .outcome = row.Text(4),
          .reason = row.Text(5),
          .simulated = row.Real(6),
          .steps = row.Integer(7),
          .errors_signalled = row.Int(8),
          .recovered = row.Int(9),
          .operator_called = row.Int(10) != 0,
          .warnings = row.Text(11),
          .counts = {row.Int(12), row.Int(13), row.Int(14), row.Int(15)}};
}

std::vector<VerdictRecord> ReadVerdicts(const Database& database, int trial) {
  std::vector<VerdictRecord> verdicts;
  Statement rows = database.Prepare(
      "SELECT step, action, verdict, claim, observed, low, high, margin, gate FROM verdict "
      "WHERE trial = ? ORDER BY step");
  rows.Bind(trial);
  while (rows.Next()) {
    verdicts.push_back({.step = rows.Int(0),
                        .action = rows.Text(1),
                        .verdict = rows.Text(2),
                        .claim = rows.Text(3),
                        .observed = rows.Real(4),
                        .low = rows.Real(5),
                        .high = rows.Real(6),
                        .margin = rows.Real(7),
                        .gate = rows.Real(8)});
  }
  return verdicts;
}

std::vector<ObservationRecord> ReadObservations(const Database& database, int trial) {
  std::vector<ObservationRecord> observations;
  Statement rows =
      database.Prepare("SELECT claim, observed FROM observation WHERE trial = ? ORDER BY claim");
  rows.Bind(trial);
  while (rows.Next()) observations.push_back({rows.Text(0), rows.Real(1)});
  return observations;
}

std::vector<WorstClaimRecord> ReadWorst(const Database& database, int cell) {
  std::vector<WorstClaimRecord> worst;
  Statement rows = database.Prepare(
      "SELECT claim, step, action, about, name, unit, observed, low, high, "
      "margin, gate, verdict, "
      "phase, attempt, noise FROM attack_worst WHERE cell = ? ORDER BY claim");
  rows.Bind(cell);
  while (rows.Next()) {
    worst.push_back({.claim = rows.Text(0),
                     .step = rows.Int(1),
                     .action = rows.Text(2),
                     .about = rows.Text(3),
                     .name = rows.Text(4),
                     .dimension = DimensionNamed(rows.Text(5)),
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

std::vector<CounterexampleRecord> ReadCounterexamples(const Database& database, int cell) {
  std::vector<CounterexampleRecord> examples;
  Statement rows = database.Prepare(
      "SELECT number, claim, action, name, unit, observed, "
      "low, high, margin, gate, noise, steps, "
      "replayed, multiple, replay FROM counterexample WHERE "
      "cell = ? ORDER BY number");
  rows.Bind(cell);
  while (rows.Next()) {
    examples.push_back({.number = rows.Int(0),
                        .claim = rows.Text(1),
                        .action = rows.Text(2),
                        .name = rows.Text(3),
                        .dimension = DimensionNamed(rows.Text(4)),
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

// A missing value is NULL in the database.
double OrNull(const std::optional<double>& value) {
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}
std::optional<double> UnlessNull(double value) {
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

std::vector<ConservatismRecord> ReadConservatism(const Database& database, int cell) {
  std::vector<ConservatismRecord> ratios;
  Statement rows = database.Prepare(
      "SELECT variable, guaranteed, broken, "
      "ratio FROM conservatism WHERE cell = ? "
      "ORDER BY variable");
  rows.Bind(cell);
  while (rows.Next()) {
    ratios.push_back(
        {rows.Text(0), rows.Real(1), UnlessNull(rows.Real(2)), UnlessNull(rows.Real(3))});
  }
  return ratios;
}

// Returns in words what differs.
std::string Difference(const std::string& key) {
  if (key == "text") return "the sweep file has changed";
  if (key == "version") return "another version of the program made it";
  if (key.starts_with("scenario ")) return fmt::format("{} has changed", key);
  return fmt::format("its {} differs", key);
}

}  // namespace

domain::Dimension DimensionNamed(const std::string& unit) {
  const auto dimension = domain::DimensionIn(unit);
  if (!dimension) {
    throw InputError({.file = "the database"}, fmt::format("'{}' is no unit of claims", unit),
                     "a database as it was written");
  }
  return *dimension;
}

// The statements that write cells and trials, each prepared once.
struct Store::Writing {
  explicit Writing(const Database& database)
      : trial(database.Prepare("INSERT INTO trial VALUES(?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)")),
        verdict(database.Prepare("INSERT INTO verdict VALUES(?,?,?,?,?,?,?,?,?,?)")),
        claim(database.Prepare("INSERT OR IGNORE INTO claim VALUES(?,?,?,?,?,?,?,?,?,?,?)")),
        observation(database.Prepare("INSERT INTO observation VALUES(?,?,?)")),
        timing(database.Prepare("INSERT INTO timing VALUES(?,?)")),
        cell(database.Prepare("INSERT INTO cell VALUES(?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)")),
        gate(database.Prepare("INSERT INTO gate VALUES(?,?,?,?,?,?)")),
        component(database.Prepare("INSERT INTO gate_component VALUES(?,?,?,?,?,?,?)")),
        planning(database.Prepare("INSERT INTO planning VALUES(?,?)")),
        attack(database.Prepare("INSERT INTO attack VALUES(?,?,?,?,?,?,?,?,?,?)")),
        worst(database.Prepare("INSERT INTO attack_worst "
                               "VALUES(?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)")),
        counterexample(database.Prepare("INSERT INTO counterexample "
                                        "VALUES(?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)")),
        conservatism(database.Prepare("INSERT INTO conservatism VALUES(?,?,?,?,?)")) {}

  Statement trial, verdict, claim, observation, timing, cell, gate, component, planning;
  Statement attack, worst, counterexample, conservatism;
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
    store.RequireFormat();
    store.RequireSameSweep(facts);
  }
  store.writing_ = std::make_shared<Writing>(*store.database_);
  return store;
}

Store Store::Open(const fs::path& file) {
  if (IsEmptyOrMissing(file)) {
    throw InputError({.file = file.string()}, "there is no database in it",
                     "a database that assay sweep has written");
  }
  Store store(file, Database::Access::kRead);
  store.RequireFormat();
  return store;
}

void Store::Initialize(const SweepFacts& facts) {
  Transaction transaction(*database_);
  database_->Execute(kSchema);
  Statement insert = database_->Prepare("INSERT INTO sweep VALUES(?,?)");
  for (const auto& [key, value] : facts) insert.Bind(key, value).Run();
  database_->Execute(fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}",
                                 kApplicationId, kFormatVersion));
  transaction.Commit();
}

void Store::Refuse(const std::string& what, const std::string& allowed) const {
  throw InputError({.file = file().string()}, what, allowed);
}

void Store::RequireFormat() const {
  if (database_->Integer("PRAGMA application_id") != kApplicationId) {
    Refuse("a database of another program", "a database that assay sweep has written");
  }
  const std::int64_t version = database_->Integer("PRAGMA user_version");
  if (version != kFormatVersion) {
    Refuse(fmt::format("written in version {} of the format, by {} assay", version,
                       version < kFormatVersion ? "an older" : "a newer"),
           fmt::format("version {}: do the sweep again, into a new file, or read it with the "
                       "program that has written it",
                       kFormatVersion));
  }
  Statement check = database_->Prepare("PRAGMA quick_check(1)");
  if (check.Next() && check.Text(0) != "ok") {
    Refuse(fmt::format("the database is damaged ({})", check.Text(0)),
           "an undamaged one; sqlite3's .recover saves what can be read");
  }
  RequireTables();
  RequireTypes();
  RequireContents();
}

// SQLite stores the statements that made the tables, so that they can be compared with kSchema.
void Store::RequireTables() const {
  Statement made = database_->Prepare("SELECT count(*) FROM sqlite_schema WHERE sql = ?");
  for (std::string_view rest = kSchema; rest.find(';') != std::string_view::npos;) {
    std::string_view statement = rest.substr(0, rest.find(';'));
    rest.remove_prefix(statement.size() + 1);
    statement.remove_prefix(std::min(statement.find("CREATE"), statement.size()));
    made.Bind(statement);
    const bool is_there = made.Next() && made.Integer(0) == 1;
    if (is_there) continue;
    Refuse(fmt::format("a table or index is missing or differs; expected: {}",
                       statement.substr(0, statement.find('('))),
           "the tables as assay sweep makes them");
  }
}

// The types are checked because SQLite stores values of any type in any column.
void Store::RequireTypes() const {
  const std::map<std::string, std::string> allowed = {{"INTEGER", "'integer', 'null'"},
                                                      {"REAL", "'real', 'integer', 'null'"},
                                                      {"TEXT", "'text', 'null'"}};
  Statement columns = database_->Prepare(
      "SELECT m.name, c.name, c.type FROM sqlite_schema m, pragma_table_info(m.name) c"
      " WHERE m.type = 'table' ORDER BY m.name, c.cid");
  while (columns.Next()) {
    const std::string table = columns.Text(0);
    const std::string column = columns.Text(1);
    const auto types = allowed.find(columns.Text(2));
    if (types == allowed.end()) continue;  // a table of another program
    const std::int64_t wrong = database_->Integer(
        fmt::format("SELECT count(*) FROM \"{}\" WHERE typeof(\"{}\") NOT IN ({})", table, column,
                    types->second));
    if (wrong == 0) continue;
    Refuse(fmt::format("column {} of table {} has {} values of another type", column, table, wrong),
           types->first);
  }
}

void Store::RequireContents() const {
  Statement orphans = database_->Prepare("PRAGMA foreign_key_check");
  if (orphans.Next()) {
    Refuse(fmt::format("a row of table {} belongs to no row of table {}", orphans.Text(0),
                       orphans.Text(2)),
           "rows as assay sweep writes them");
  }
  for (const auto& [query, allowed] : kContentRules) {
    Statement wrong = database_->Prepare(query);
    if (wrong.Next()) Refuse(wrong.Text(0), allowed);
  }
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
  const auto& [trials, steps, seconds] = run.throughput;
  database_->Prepare("INSERT INTO run VALUES(NULL,?,?,?,?,?,?,?,?,?,?)")
      .Bind(run.started, run.shard, run.jobs, run.version, run.machine, run.cores, run.os, trials,
            steps, seconds)
      .Run();
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
  writing_->cell
      .Bind(cell.cell, cell.scenario, cell.clearance, cell.error_scale, cell.propagation,
            cell.resolvers, cell.noise, cell.sensing, cell.seed, cell.trials, cell.grasp,
            cell.outcome, cell.actions, cell.errors, cell.proved, cell.conflict, cell.plan)
      .Run();
  for (std::size_t id = 0; id < cell.gate.steps.size(); ++id) {
    WriteGate(cell.cell, static_cast<int>(id), cell.gate.steps[id]);
  }
}

void Store::WriteGate(int cell, int id, const check::StepNoiseFloor& gate) {
  // The structured binding lets the compiler find a new member that has no column yet.
  const auto& [components, arm, penetration, lag, lag_turn] = gate;
  writing_->gate.Bind(cell, id, arm, penetration, lag, lag_turn).Run();
  int number = 0;
  for (const auto& [about, name, offset, step_size] : components) {
    writing_->component.Bind(cell, id, number++, check::Name(about), name, offset, step_size).Run();
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
  const VerdictCounts& counts = trial.counts;
  writing_->trial
      .Bind(trial.trial, trial.cell, trial.number, trial.noise, trial.outcome, trial.reason,
            trial.simulated, trial.steps, trial.errors_signalled, trial.recovered,
            trial.operator_called, trial.warnings, counts.contained, counts.inconclusive,
            counts.violated, counts.not_claimed, ReplayCommand(trial.trial))
      .Run();
  for (const ClaimRecord& claim : timed.claims) {
    writing_->claim
        .Bind(trial.cell, claim.claim, claim.step, claim.action, claim.about, claim.name,
              NameOf(claim.dimension), claim.low, claim.high, claim.proved, claim.gate)
        .Run();
  }
  for (const VerdictRecord& verdict : trial.verdicts) {
    writing_->verdict
        .Bind(trial.trial, verdict.step, verdict.action, verdict.verdict, verdict.claim,
              verdict.observed, verdict.low, verdict.high, verdict.margin, verdict.gate)
        .Run();
  }
  for (const ObservationRecord& observation : trial.observations) {
    writing_->observation.Bind(trial.trial, observation.claim, observation.observed).Run();
  }
  if (timed.attack) WriteAttack(trial.cell, *timed.attack);
  writing_->timing.Bind(trial.trial, timed.seconds).Run();
}

void Store::WriteAttack(int cell, const AttackRecord& attack) {
  const VerdictCounts& steps = attack.certificates;
  const VerdictCounts& claims = attack.claims;
  writing_->attack
      .Bind(cell, attack.attempts, steps.contained, steps.inconclusive, steps.violated,
            steps.not_claimed, claims.contained, claims.inconclusive, claims.violated,
            claims.not_claimed)
      .Run();
  for (const WorstClaimRecord& worst : attack.worst) {
    writing_->worst
        .Bind(cell, worst.claim, worst.step, worst.action, worst.about, worst.name,
              NameOf(worst.dimension), worst.observed, worst.low, worst.high, worst.margin,
              worst.gate, worst.verdict, worst.phase, worst.attempt, worst.noise)
        .Run();
  }
  for (const CounterexampleRecord& example : attack.counterexamples) {
    writing_->counterexample
        .Bind(cell, example.number, example.claim, example.action, example.name,
              NameOf(example.dimension), example.observed, example.low, example.high,
              example.margin, example.gate, example.noise, example.steps, example.replayed,
              example.multiple, example.replay)
        .Run();
  }
  for (const ConservatismRecord& ratio : attack.conservatism) {
    writing_->conservatism
        .Bind(cell, ratio.variable, ratio.guaranteed, OrNull(ratio.broken), OrNull(ratio.ratio))
        .Run();
  }
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

// The conversion cannot fail, because RequireContents has checked the value.
int Store::TrialsInAll() const { return std::stoi(Facts().at("trials")); }

std::vector<RunRecord> Store::Runs() const {
  std::vector<RunRecord> runs;
  Statement rows = database_->Prepare(
      "SELECT started, shard, jobs, version, machine, cores, os, trials, steps, seconds FROM run "
      "ORDER BY run");
  while (rows.Next()) {
    runs.push_back({rows.Text(0),
                    rows.Text(1),
                    rows.Int(2),
                    rows.Text(3),
                    rows.Text(4),
                    rows.Int(5),
                    rows.Text(6),
                    {rows.Int(7), rows.Integer(8), rows.Real(9)}});
  }
  return runs;
}

std::vector<CellRecord> Store::Cells() const {
  std::vector<CellRecord> cells;
  Statement rows = database_->Prepare("SELECT * FROM cell ORDER BY cell");
  while (rows.Next()) {
    cells.push_back(ReadCell(rows));
    cells.back().gate = ReadGate(*database_, cells.back().cell);
  }
  return cells;
}

std::vector<ClaimRecord> Store::Claims(int cell) const {
  std::vector<ClaimRecord> claims;
  Statement rows = database_->Prepare(
      "SELECT claim, step, action, about, name, unit, low, high, proved, gate FROM claim "
      "WHERE cell = ? ORDER BY step, claim");
  rows.Bind(cell);
  while (rows.Next()) {
    claims.push_back({rows.Text(0), rows.Int(1), rows.Text(2), rows.Text(3), rows.Text(4),
                      DimensionNamed(rows.Text(5)), rows.Real(6), rows.Real(7), rows.Int(8) != 0,
                      rows.Real(9)});
  }
  return claims;
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
  TrialRecord record = ReadTrial(row);
  record.verdicts = ReadVerdicts(*database_, trial);
  record.observations = ReadObservations(*database_, trial);
  return record;
}

std::optional<AttackRecord> Store::FindAttack(int cell) const {
  Statement row = database_->Prepare("SELECT * FROM attack WHERE cell = ?");
  row.Bind(cell);
  if (!row.Next()) return std::nullopt;
  return AttackRecord{.attempts = row.Integer(1),
                      .certificates = {row.Int(2), row.Int(3), row.Int(4), row.Int(5)},
                      .claims = {row.Int(6), row.Int(7), row.Int(8), row.Int(9)},
                      .worst = ReadWorst(*database_, cell),
                      .counterexamples = ReadCounterexamples(*database_, cell),
                      .conservatism = ReadConservatism(*database_, cell)};
}

double Store::MeanSeconds() const {
  Statement row = database_->Prepare(
      "SELECT coalesce(avg(seconds), 0) FROM timing JOIN trial USING(trial)"
      " WHERE cell NOT IN (SELECT cell FROM attack)");
  return row.Next() ? row.Real(0) : 0;
}

}  // namespace assay::sweep
