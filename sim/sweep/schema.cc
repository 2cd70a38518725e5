#include "sim/sweep/schema.h"

namespace assay::sweep {

// Lengths are metres, angles radians, times seconds; gate.id is a StepId; run.steps are of the
// engine, in run.seconds of sampled trials. A broken or ratio that is NULL: nothing broke. Keys are
// given by the grid, not by the order of writing, so that the rows of a table are in one order,
// whoever wrote them when.
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
