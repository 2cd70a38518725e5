#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/sweep/database/database.h"
#include "sim/sweep/database/records.h"
#include "sim/sweep/grid/sweep_file.h"

namespace assay::sweep {

// Returns the facts that identify a sweep, by which its database is distinguished from others. They
// are the "format" and "text" of the sweep file, the "version" of the program, the number of all
// "trials", and the text of each scenario file under the key "scenario PATH". The "path" of the
// sweep file is stored, too, but may differ.
using SweepFacts = std::map<std::string, std::string>;
SweepFacts FactsOf(const Sweep& sweep, const std::string& version);

// A finished trial and the time that it took.
struct TimedTrial {
  TrialRecord record;
  // The claims of its observations. Claims that are stored already are ignored.
  std::vector<ClaimRecord> claims = {};
  double seconds = 0;
  std::optional<FalsificationRecord> falsification = {};  // only if it is a falsification
  // The verdicts of `record` in the same order, with all of their claims. These claims are not
  // stored.
  std::vector<check::CertificateVerdict> verdicts = {};
};

// The results of a sweep in an SQLite database. Its tables are sweep, run, cell, gate,
// gate_component, claim, trial, verdict, observation, attack, attack_worst, counterexample,
// conservatism, timing and planning (schema.cc). In all releases of the program that have the same
// version of the format, the tables have the same meaning. For the same sweep, all tables but
// `run`, `timing` and `planning` are the same, row for row, except for the file paths in stored
// commands. They do not depend on the number of threads, shards and starts of the program.
//
// Added data are on the disk when the call returns, either all of them or none. Errors are those of
// Database.
class Store {
 public:
  // Makes a new database. Throws InputError if the file is not empty.
  static Store Create(const std::filesystem::path& file, const SweepFacts& facts);
  // Opens a database to continue its sweep, or makes a new one if the file is missing or empty.
  // Throws InputError if it belongs to another sweep.
  static Store Resume(const std::filesystem::path& file, const SweepFacts& facts);
  // Opens a database for reading. Resume and Open throw InputError unless the file is an undamaged
  // database of this program and of this version of the format, with all tables and with contents
  // that obey the rules (schema.h).
  static Store Open(const std::filesystem::path& file);

  // Throws InputError if the database belongs to another sweep.
  void RequireSameSweep(const SweepFacts& facts) const;

  const std::filesystem::path& file() const { return database_->file(); }

  void Add(const RunRecord& run);
  // Sets the throughput of the run that was added last.
  void Finish(const Throughput& throughput);
  // Adds cells that share a plan. `seconds` is the planning time for all of them.
  void Add(const std::vector<CellRecord>& cells, double seconds);
  void Add(const std::vector<TimedTrial>& trials);
  // Closes the database and makes it a single file, which can be copied and read anywhere.
  void Close();

  SweepFacts Facts() const;
  int TrialsInAll() const;  // number of trials of the sweep, done or not
  std::vector<RunRecord> Runs() const;
  std::vector<CellRecord> Cells() const;  // in the order of their numbers
  std::vector<ClaimRecord> Claims(int cell) const;
  std::vector<int> Trials() const;  // numbers of the done trials, in order
  std::optional<TrialRecord> FindTrial(int trial) const;
  std::optional<FalsificationRecord> FindFalsification(int cell) const;
  // Returns the mean time of the trials that are not falsifications; 0 if none is done.
  double MeanSeconds() const;

  Database& database() { return *database_; }
  const Database& database() const { return *database_; }

 private:
  struct Writing;  // prepared statements
  Store(const std::filesystem::path& file, Database::Access access);
  void Initialize(const SweepFacts& facts);
  void WriteCell(const CellRecord& cell);
  void WriteGate(int cell, int id, const check::StepNoiseFloor& gate);
  void WriteTrial(const TimedTrial& trial);
  void WriteFalsification(int cell, const FalsificationRecord& falsification);

  std::unique_ptr<Database> database_;  // on the heap, because statements refer to its address
  std::shared_ptr<Writing> writing_;
};

}  // namespace assay::sweep
