#include "sim/sweep/store/schema.h"

#include <array>

namespace assay::sweep {
namespace {

constexpr std::array kRules = {
    ContentRule{"SELECT 'the sweep has no ' || column1 FROM"
                " (VALUES ('format'), ('path'), ('text'), ('version'), ('trials'))"
                " WHERE column1 NOT IN (SELECT key FROM sweep)",
                "format, path, text, version and trials in table sweep"},
    ContentRule{"SELECT 'the sweep has ' || value || ' trials' FROM sweep WHERE key = 'trials'"
                " AND (CAST(value AS INTEGER) || '' <> value"
                " OR CAST(value AS INTEGER) NOT BETWEEN 1 AND 1000000000)",
                "a number from 1 to 1000000000"},
    ContentRule{"SELECT 'cell ' || cell || ' has the outcome ' || outcome FROM cell"
                " WHERE outcome NOT IN ('planned', 'untestable', 'none', 'budget')",
                "planned, untestable, none, budget"},
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

}  // namespace

const std::span<const ContentRule> kContentRules = kRules;

// Lengths are in metres, angles in radians, and times in seconds. gate.id is a StepId. run.steps
// are timesteps of the engine in run.seconds, without falsifications. If conservatism.broken or
// .ratio is NULL, nothing broke the plan. The grid determines the keys, so that the rows of a table
// have the same order, whatever the order in which they were written.
const char* const kSchema = R"sql(
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

}  // namespace assay::sweep
