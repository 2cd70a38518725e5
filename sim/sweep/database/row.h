#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "sim/sweep/database/database.h"
#include "sim/sweep/database/records.h"
#include "sim/sweep/database/schema.h"

// The rows of the database as C++ records. One list of columns for each table serves both to write
// and to read.
namespace assay::sweep {

// A record, const or not.
template <class T, class Record>
concept Is = std::same_as<std::remove_const_t<T>, Record>;

// Columns(record) returns a tuple of references to the record's fields, in the order of the columns
// of its table (schema.cc). The keys that come before the record's own columns, such as the number
// of the trial, are left out.
auto Columns(Is<CellRecord> auto& r) {
  return std::tie(r.cell, r.scenario, r.clearance, r.error_scale, r.propagation, r.resolvers,
                  r.noise, r.sensing, r.seed, r.trials, r.grasp, r.outcome, r.actions, r.errors,
                  r.proved, r.conflict, r.plan);
}
// The structured binding lets the compiler find a new member that has no column yet.
auto Columns(Is<check::StepNoiseFloor> auto& r) {
  auto& [components, arm, penetration, lag, lag_turn] = r;
  return std::tie(arm, penetration, lag, lag_turn);
}
auto Columns(Is<check::ClaimNoiseFloor> auto& r) {
  auto& [about, name, offset, step_size] = r;
  return std::tie(about, name, offset, step_size);
}
auto Columns(Is<ClaimRecord> auto& r) {
  return std::tie(r.claim, r.step, r.action, r.about, r.name, r.dimension, r.low, r.high, r.proved,
                  r.gate);
}
auto Columns(Is<VerdictCounts> auto& r) {
  return std::tie(r.contained, r.inconclusive, r.violated, r.not_claimed);
}
auto Columns(Is<TrialRecord> auto& r) {
  return std::tuple_cat(
      std::tie(r.trial, r.cell, r.number, r.noise, r.outcome, r.reason, r.simulated, r.steps,
               r.errors_signalled, r.recovered, r.operator_called, r.warnings),
      Columns(r.counts));
}
auto Columns(Is<VerdictRecord> auto& r) {
  return std::tie(r.step, r.action, r.verdict, r.claim, r.observed, r.low, r.high, r.margin,
                  r.gate);
}
auto Columns(Is<ObservationRecord> auto& r) { return std::tie(r.claim, r.observed); }
auto Columns(Is<FalsificationRecord> auto& r) {
  return std::tuple_cat(std::tie(r.attempts), Columns(r.certificates), Columns(r.claims));
}
auto Columns(Is<WorstClaimRecord> auto& r) {
  return std::tie(r.claim, r.step, r.action, r.about, r.name, r.dimension, r.observed, r.low,
                  r.high, r.margin, r.gate, r.verdict, r.phase, r.attempt, r.noise);
}
auto Columns(Is<CounterexampleRecord> auto& r) {
  return std::tie(r.number, r.claim, r.action, r.name, r.dimension, r.observed, r.low, r.high,
                  r.margin, r.gate, r.noise, r.steps, r.replayed, r.multiple, r.replay);
}
auto Columns(Is<ConservatismRecord> auto& r) {
  return std::tie(r.variable, r.guaranteed, r.broken, r.ratio);
}

auto Columns(Is<RunRecord> auto& r) {
  return std::tie(r.started, r.shard, r.jobs, r.version, r.machine, r.cores, r.os,
                  r.throughput.trials, r.throughput.steps, r.throughput.seconds);
}

// Return a member's value as a statement binds it. A missing number is NaN here and NULL in the
// database.
template <class T>
const T& ColumnValue(const T& value) {
  return value;
}
inline double ColumnValue(const std::optional<double>& value) {
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}
inline std::string_view ColumnValue(check::Claimed about) { return check::Name(about); }
inline std::string_view ColumnValue(domain::Dimension dimension) {
  return domain::SiUnitOf(dimension).name;
}

// Set a member from a column of a row. RequireSchema has ensured that the contents of the database
// are right, except for units. DimensionNamed checks the units.
inline void ReadColumn(const Statement& row, int i, int& to) { to = row.Int(i); }
inline void ReadColumn(const Statement& row, int i, std::int64_t& to) { to = row.Integer(i); }
inline void ReadColumn(const Statement& row, int i, bool& to) { to = row.Int(i) != 0; }
inline void ReadColumn(const Statement& row, int i, double& to) { to = row.Real(i); }
inline void ReadColumn(const Statement& row, int i, std::string& to) { to = row.Text(i); }
inline void ReadColumn(const Statement& row, int i, std::optional<double>& to) {
  const double value = row.Real(i);
  to = std::isnan(value) ? std::nullopt : std::optional(value);
}
inline void ReadColumn(const Statement& row, int i, domain::Dimension& to) {
  to = DimensionNamed(row.Text(i));
}
inline void ReadColumn(const Statement& row, int i, check::Claimed& to) {
  to = check::Claimed::kAfter;
  for (const auto about : {check::Claimed::kBefore, check::Claimed::kPrecondition}) {
    if (check::Name(about) == row.Text(i)) to = about;
  }
}

// Executes a statement that writes one row: the keys, the record's columns, and what follows them.
template <class Record, class... Keys, class... Rest>
void WriteRow(Statement& statement, const std::tuple<Keys...>& keys, const Record& record,
              const Rest&... rest) {
  std::apply([&](const auto&... values) { statement.Bind(ColumnValue(values)...).Run(); },
             std::tuple_cat(keys, Columns(record), std::tie(rest...)));
}

// Writes one row for each record, with the same key.
template <class Record>
void WriteRows(Statement& statement, int key, const std::vector<Record>& records) {
  for (const Record& record : records) WriteRow(statement, std::tuple(key), record);
}

// Returns a record from a row whose first columns are keys. `keys` is the number of these columns.
template <class Record>
Record ReadRow(const Statement& row, int keys) {
  Record record;
  int column = keys;
  std::apply([&](auto&... members) { (ReadColumn(row, column++, members), ...); }, Columns(record));
  return record;
}

// Returns the records of the rows that a query finds: "verdict WHERE trial = ? ORDER BY step". The
// first `keys` columns of the rows are keys.
template <class Record, class... Values>
std::vector<Record> ReadRows(const Database& database, std::string_view from, int keys,
                             const Values&... values) {
  std::vector<Record> records;
  Statement rows = database.Prepare(fmt::format("SELECT * FROM {}", from));
  rows.Bind(values...);
  while (rows.Next()) records.push_back(ReadRow<Record>(rows, keys));
  return records;
}

// Returns the statement that inserts a row with all columns of the table. `conflict` is SQL that
// says what happens to a row with the same key: "ON CONFLICT ...".
inline Statement Insertion(const Database& database, std::string_view table,
                           std::string_view conflict = "") {
  const std::int64_t columns =
      database.Integer(fmt::format("SELECT count(*) FROM pragma_table_info('{}')", table));
  const std::vector<std::string_view> parameters(static_cast<std::size_t>(columns), "?");
  return database.Prepare(
      fmt::format("INSERT INTO {} VALUES({}) {}", table, fmt::join(parameters, ","), conflict));
}

}  // namespace assay::sweep
