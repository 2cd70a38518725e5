#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/sweep/run/sweep_file.h"
#include "sim/sweep/store/database.h"
#include "sim/sweep/store/records.h"

namespace assay::sweep {

// What a sweep is, by which a database is told from that of another one: "format" and "text" of the
// sweep file, the program's "version", "trials" in all, and the text of each scenario file as
// "scenario PATH"; and the sweep file's "path", which may differ.
using SweepFacts = std::map<std::string, std::string>;
SweepFacts FactsOf(const Sweep& sweep, const std::string& version);

// How fast trials were done, attacks left out.
struct Throughput {
  int trials = 0;
  std::int64_t steps = 0;  // of the engine
  double seconds = 0;      // from the first trial's start to the last one's end, on all threads

  double StepsPerSecond() const { return seconds > 0 ? static_cast<double>(steps) / seconds : 0; }
};

// One start of the program on a database: a row of table `run`, which differs between machines.
struct RunRecord {
  std::string started;  // UTC
  std::string shard;    // "1/1"
  int jobs = 1;
  std::string version, machine;
  int cores = 0;
  std::string os;
  Throughput throughput = {};  // nothing until it ends
};

// What was finished, and how long it took.
struct TimedTrial {
  TrialRecord record;
  std::vector<ClaimRecord> claims = {};  // of its observations; those that are known already do
                                         // not matter
  double seconds = 0;
  std::optional<AttackRecord> attack = {};  // if it is one
  // The verdicts of `record`, in the same order, with all of their claims. They are not stored.
  std::vector<check::CertificateVerdict> verdicts = {};
};

// The results of a sweep in an SQLite database, in tables that keep their meaning once released:
// sweep, run, cell, gate, gate_component, claim, trial, verdict, observation, attack, attack_worst,
// counterexample, conservatism, timing and planning (schema.cc). All but `run`, `timing` and
// `planning` are the same, row for row, for the same sweep, in however many threads, shards and
// starts it was done.
//
// What is added is on the disk when the call returns, all of it or nothing. Errors as of Database.
class Store {
 public:
  // A new database. Throws InputError if there is something in the file.
  static Store Create(const std::filesystem::path& file, const SweepFacts& facts);
  // One that is to be gone on with; if the file is not there or still empty, a new one. Throws
  // InputError if it belongs to another sweep.
  static Store Resume(const std::filesystem::path& file, const SweepFacts& facts);
  // One that is only read. Like Resume it throws InputError unless the file is a database of ours,
  // of this version, undamaged, with all tables and with contents that can be (schema.h).
  static Store Open(const std::filesystem::path& file);

  // Throws InputError if it belongs to another sweep.
  void RequireSameSweep(const SweepFacts& facts) const;

  const std::filesystem::path& file() const { return database_->file(); }

  void Add(const RunRecord& run);
  void Finish(const Throughput& throughput);  // of the run that was added last
  // Cells that share a plan, and how long planning took for all of them.
  void Add(const std::vector<CellRecord>& cells, double seconds);
  void Add(const std::vector<TimedTrial>& trials);
  // The database becomes a single file again, which can be copied and read anywhere.
  void Close();

  SweepFacts Facts() const;
  int TrialsInAll() const;  // of the sweep, done or not
  std::vector<RunRecord> Runs() const;
  std::vector<CellRecord> Cells() const;  // by number
  std::vector<ClaimRecord> Claims(int cell) const;
  std::vector<int> Trials() const;  // that are done, in order
  std::optional<TrialRecord> FindTrial(int trial) const;
  std::optional<AttackRecord> FindAttack(int cell) const;
  double MeanSeconds() const;  // of the trials that are no attacks; 0: none is done

  Database& database() { return *database_; }
  const Database& database() const { return *database_; }

 private:
  struct Writing;  // statements
  Store(const std::filesystem::path& file, Database::Access access);
  void Initialize(const SweepFacts& facts);
  void RequireFormat() const;
  void RequireTables() const;
  void RequireTypes() const;
  void RequireContents() const;
  [[noreturn]] void Refuse(const std::string& what, const std::string& allowed) const;
  void WriteCell(const CellRecord& cell);
  void WriteGate(int cell, int id, const check::StepNoiseFloor& gate);
  void WriteTrial(const TimedTrial& trial);
  void WriteAttack(int cell, const AttackRecord& attack);

  std::unique_ptr<Database> database_;  // does not move: statements refer to it
  std::shared_ptr<Writing> writing_;
};

}  // namespace assay::sweep
