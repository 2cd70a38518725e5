#include "sim/sweep/database/schema.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "planner/base/input_files/input_error.h"
#include "sim/execution/trial/trial_outcome.h"

namespace assay::sweep {
namespace {

constexpr int kApplicationId = 0x41535359;  // "ASSY"
constexpr int kFormatVersion = 4;           // stored as user_version of the database

// A rule for the contents of rows, beyond the types of their columns. The program accepts only
// databases that obey all rules.
struct ContentRule {
  const char* wrong;  // a query that returns a description of each wrong row
  const char* allowed;
};
constexpr std::array kContentRules = {
    ContentRule{"SELECT 'the sweep has no ' || column1 FROM"
                " (VALUES ('format'), ('path'), ('text'), ('version'), ('trials'))"
                " WHERE column1 NOT IN (SELECT key FROM sweep)",
                "format, path, text, version and trials in table sweep"},
    ContentRule{"SELECT 'the sweep has the format ' || value FROM sweep WHERE key = 'format'"
                " AND value <> 'assay-sweep/1'",
                "assay-sweep/1"},
    ContentRule{"SELECT 'the sweep has ' || value || ' trials' FROM sweep WHERE key = 'trials'"
                " AND (CAST(value AS INTEGER) || '' <> value"
                " OR CAST(value AS INTEGER) NOT BETWEEN 1 AND 1000000000)",
                "a number from 1 to 1000000000"},
    ContentRule{"SELECT 'cell ' || cell || ' has the outcome ' || outcome FROM cell"
                " WHERE outcome NOT IN ('planned', 'untestable', 'none', 'budget')",
                "planned, untestable, none, budget"},
    ContentRule{"SELECT 'cell ' || cell || ' has the noise ' || noise FROM cell"
                " WHERE noise NOT IN ('none', 'uniform', 'vertices', 'low-discrepancy', 'attack')",
                "none, uniform, vertices, low-discrepancy, attack"},
    ContentRule{"SELECT 'there is a cell ' || cell || ' of ' || trials || ' trials' FROM cell"
                " WHERE cell < 1 OR trials < 0",
                "numbers from 1 on"},
    ContentRule{"SELECT 'there is a trial ' || trial || ', number ' || number || ' of its cell'"
                " FROM trial WHERE number < 1 OR trial NOT BETWEEN 1 AND"
                " (SELECT CAST(value AS INTEGER) FROM sweep WHERE key = 'trials')",
                "numbers from 1 on, up to those of the sweep"},
    ContentRule{"SELECT 'trial ' || trial || ' has counts below 0' FROM trial WHERE"
                " min(contained, inconclusive, violated, not_claimed, errors_signalled, recovered,"
                " coalesce(steps, 0)) < 0",
                "0 or more"},
    ContentRule{"SELECT 'a verdict of trial ' || trial || ' is ' || verdict FROM verdict WHERE"
                " verdict NOT IN ('contained', 'violated', 'inconclusive', 'not-claimed')",
                "contained, violated, inconclusive, not-claimed"},
    ContentRule{"SELECT 'a verdict of the attack on cell ' || cell || ' is ' || verdict FROM"
                " attack_worst WHERE"
                " verdict NOT IN ('contained', 'violated', 'inconclusive', 'not-claimed')",
                "contained, violated, inconclusive, not-claimed"},
};

// Lengths are in metres, angles in radians, and times in seconds. gate.id is a StepId. run.steps
// are timesteps of the engine in run.seconds, without falsifications. If conservatism.broken or
// .ratio is NULL, nothing broke the plan. The grid determines the keys, so that the rows of a table
// have the same order, whatever the order in which they were written.
// The tables of an existing database are compared with these statements word for word. Therefore
// any change, even of a space, needs a new version of the format.
constexpr const char* kSchema = R"sql(
CREATE TABLE sweep(key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;

CREATE TABLE run(
  run INTEGER PRIMARY KEY, started TEXT, shard TEXT, jobs INTEGER, version TEXT, machine TEXT,
  cores INTEGER, os TEXT, trials INTEGER NOT NULL, steps INTEGER NOT NULL, seconds REAL NOT NULL);

CREATE TABLE cell(
  cell INTEGER PRIMARY KEY, scenario TEXT NOT NULL, clearance REAL NOT NULL,
  error_scale REAL NOT NULL, propagation TEXT NOT NULL, resolvers TEXT NOT NULL,
  noise TEXT NOT NULL, sensing TEXT NOT NULL, seed INTEGER NOT NULL, trials INTEGER NOT NULL, grasp TEXT NOT NULL,
  outcome TEXT NOT NULL, actions INTEGER NOT NULL, errors INTEGER NOT NULL,
  proved INTEGER NOT NULL, conflict TEXT NOT NULL, plan TEXT NOT NULL);

CREATE TABLE gate(
  cell INTEGER NOT NULL REFERENCES cell, id INTEGER NOT NULL, arm REAL, penetration REAL,
  lag REAL, lag_turn REAL, PRIMARY KEY(cell, id)) WITHOUT ROWID;

CREATE TABLE gate_component(
  cell INTEGER NOT NULL, id INTEGER NOT NULL, component INTEGER NOT NULL, about TEXT NOT NULL,
  name TEXT NOT NULL, offset REAL, step_size REAL, PRIMARY KEY(cell, id, component),
  FOREIGN KEY(cell, id) REFERENCES gate) WITHOUT ROWID;

CREATE TABLE claim(
  cell INTEGER NOT NULL REFERENCES cell, claim TEXT NOT NULL, step INTEGER NOT NULL,
  action TEXT NOT NULL, about TEXT NOT NULL, name TEXT NOT NULL, unit TEXT NOT NULL, low REAL,
  high REAL, proved INTEGER NOT NULL, gate REAL, PRIMARY KEY(cell, claim)) WITHOUT ROWID;

CREATE TABLE trial(
  trial INTEGER PRIMARY KEY, cell INTEGER NOT NULL REFERENCES cell, number INTEGER NOT NULL,
  noise TEXT NOT NULL, outcome TEXT NOT NULL, reason TEXT NOT NULL, simulated REAL,
  steps INTEGER, errors_signalled INTEGER NOT NULL, recovered INTEGER NOT NULL,
  operator_called INTEGER NOT NULL, warnings TEXT NOT NULL, contained INTEGER NOT NULL,
  inconclusive INTEGER NOT NULL, violated INTEGER NOT NULL, not_claimed INTEGER NOT NULL,
  replay TEXT NOT NULL);
CREATE INDEX trial_of_cell ON trial(cell);

CREATE TABLE verdict(
  trial INTEGER NOT NULL REFERENCES trial, step INTEGER NOT NULL, action TEXT NOT NULL,
  verdict TEXT NOT NULL, claim TEXT NOT NULL, observed REAL, low REAL, high REAL, margin REAL,
  gate REAL, PRIMARY KEY(trial, step)) WITHOUT ROWID;

CREATE TABLE observation(
  trial INTEGER NOT NULL REFERENCES trial, claim TEXT NOT NULL, observed REAL,
  PRIMARY KEY(trial, claim)) WITHOUT ROWID;

CREATE TABLE attack(
  cell INTEGER PRIMARY KEY REFERENCES cell, attempts INTEGER NOT NULL, contained INTEGER NOT NULL,
  inconclusive INTEGER NOT NULL, violated INTEGER NOT NULL, not_claimed INTEGER NOT NULL,
  claims_contained INTEGER NOT NULL, claims_inconclusive INTEGER NOT NULL,
  claims_violated INTEGER NOT NULL, claims_not_claimed INTEGER NOT NULL);

CREATE TABLE attack_worst(
  cell INTEGER NOT NULL REFERENCES attack, claim TEXT NOT NULL, step INTEGER NOT NULL,
  action TEXT NOT NULL, about TEXT NOT NULL, name TEXT NOT NULL, unit TEXT NOT NULL, observed REAL,
  low REAL, high REAL, margin REAL, gate REAL, verdict TEXT NOT NULL, phase TEXT NOT NULL,
  attempt INTEGER NOT NULL, noise TEXT NOT NULL, PRIMARY KEY(cell, claim)) WITHOUT ROWID;

CREATE TABLE counterexample(
  cell INTEGER NOT NULL REFERENCES attack, number INTEGER NOT NULL, claim TEXT NOT NULL,
  action TEXT NOT NULL, name TEXT NOT NULL, unit TEXT NOT NULL, observed REAL, low REAL, high REAL,
  margin REAL, gate REAL, noise TEXT NOT NULL, steps INTEGER NOT NULL, replayed INTEGER NOT NULL,
  multiple REAL, replay TEXT NOT NULL, PRIMARY KEY(cell, number)) WITHOUT ROWID;

CREATE TABLE conservatism(
  cell INTEGER NOT NULL REFERENCES attack, variable TEXT NOT NULL, guaranteed REAL NOT NULL,
  broken REAL, ratio REAL, PRIMARY KEY(cell, variable)) WITHOUT ROWID;

CREATE TABLE timing(trial INTEGER PRIMARY KEY REFERENCES trial, seconds REAL NOT NULL);
CREATE TABLE planning(cell INTEGER PRIMARY KEY REFERENCES cell, seconds REAL NOT NULL);
)sql";

[[noreturn]] void Refuse(const Database& database, const std::string& what,
                         const std::string& allowed) {
  throw InputError({.file = database.file().string()}, what, allowed);
}

// The outcomes of trials, and of falsifications, which are trials too.
std::set<std::string, std::less<>> TrialOutcomes() {
  std::set<std::string, std::less<>> names = {"violated", "untried"};
  for (int i = 0; i <= static_cast<int>(execution::TrialOutcome::kMissed); ++i) {
    names.emplace(execution::Name(static_cast<execution::TrialOutcome>(i)));
  }
  return names;
}

void RequireOutcomes(const Database& database) {
  const auto allowed = TrialOutcomes();
  Statement outcomes = database.Prepare("SELECT outcome, min(trial) FROM trial GROUP BY outcome");
  while (outcomes.Next()) {
    if (allowed.contains(outcomes.Text(0))) continue;
    Refuse(database,
           fmt::format("trial {} has the outcome {}", outcomes.Integer(1), outcomes.Text(0)),
           fmt::format("{}", fmt::join(allowed, ", ")));
  }
}

// SQLite stores the statements that made the tables, so that they can be compared with kSchema.
void RequireTables(const Database& database) {
  Statement made = database.Prepare("SELECT count(*) FROM sqlite_schema WHERE sql = ?");
  for (std::string_view rest = kSchema; rest.find(';') != std::string_view::npos;) {
    std::string_view statement = rest.substr(0, rest.find(';'));
    rest.remove_prefix(statement.size() + 1);
    statement.remove_prefix(std::min(statement.find("CREATE"), statement.size()));
    made.Bind(statement);
    const bool is_there = made.Next() && made.Integer(0) == 1;
    if (is_there) continue;
    Refuse(database,
           fmt::format("a table or index is missing or differs; expected: {}",
                       statement.substr(0, statement.find('('))),
           "the tables as assay sweep makes them");
  }
}

// The types are checked because SQLite stores values of any type in any column.
void RequireTypes(const Database& database) {
  const std::map<std::string, std::string> allowed = {{"INTEGER", "'integer', 'null'"},
                                                      {"REAL", "'real', 'integer', 'null'"},
                                                      {"TEXT", "'text', 'null'"}};
  Statement columns = database.Prepare(
      "SELECT m.name, c.name, c.type FROM sqlite_schema m, pragma_table_info(m.name) c"
      " WHERE m.type = 'table' ORDER BY m.name, c.cid");
  while (columns.Next()) {
    const std::string table = columns.Text(0);
    const std::string column = columns.Text(1);
    const auto types = allowed.find(columns.Text(2));
    if (types == allowed.end()) continue;  // a table of another program
    const std::int64_t wrong =
        database.Integer(fmt::format("SELECT count(*) FROM \"{}\" WHERE typeof(\"{}\") NOT IN ({})",
                                     table, column, types->second));
    if (wrong == 0) continue;
    Refuse(database,
           fmt::format("column {} of table {} has {} values of another type", column, table, wrong),
           types->first);
  }
}

void RequireContents(const Database& database) {
  Statement orphans = database.Prepare("PRAGMA foreign_key_check");
  if (orphans.Next()) {
    Refuse(database,
           fmt::format("a row of table {} belongs to no row of table {}", orphans.Text(0),
                       orphans.Text(2)),
           "rows as assay sweep writes them");
  }
  for (const auto& [query, allowed] : kContentRules) {
    Statement wrong = database.Prepare(query);
    if (wrong.Next()) Refuse(database, wrong.Text(0), allowed);
  }
  RequireOutcomes(database);
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

void MakeTables(Database& database) {
  database.Execute(kSchema);
  database.Execute(fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}",
                               kApplicationId, kFormatVersion));
}

void RequireSchema(const Database& database) {
  if (database.Integer("PRAGMA application_id") != kApplicationId) {
    Refuse(database, "a database of another program", "a database that assay sweep has written");
  }
  const std::int64_t version = database.Integer("PRAGMA user_version");
  if (version != kFormatVersion) {
    Refuse(database,
           fmt::format("written in version {} of the format, by {} assay", version,
                       version < kFormatVersion ? "an older" : "a newer"),
           fmt::format("version {}: do the sweep again, into a new file, or read it with the "
                       "program that has written it",
                       kFormatVersion));
  }
  Statement check = database.Prepare("PRAGMA quick_check(1)");
  if (check.Next() && check.Text(0) != "ok") {
    Refuse(database, fmt::format("the database is damaged ({})", check.Text(0)),
           "an undamaged one; sqlite3's .recover saves what can be read");
  }
  RequireTables(database);
  RequireTypes(database);
  RequireContents(database);
}

}  // namespace assay::sweep
