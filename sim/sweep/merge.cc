#include "sim/sweep/merge.h"

#include <fmt/format.h>

#include <array>

#include "planner/base/input_error.h"
#include "sim/sweep/store.h"

namespace assay::sweep {
namespace {

namespace fs = std::filesystem;

// In the order of their references.
constexpr std::array kResults = {"cell",  "gate",    "gate_component", "claim",
                                 "trial", "verdict", "observation"};
constexpr std::array kTimes = {"timing", "planning"};

void CopyRun(Database& database) {
  database.Execute(
      "INSERT INTO main.run(started, shard, jobs, version, machine, cores, os)"
      " SELECT started, shard, jobs, version, machine, cores, os FROM part.run ORDER BY run");
}

void Copy(Database& database, const char* table) {
  database.Execute(fmt::format("INSERT OR IGNORE INTO main.{0} SELECT * FROM part.{0}", table));
}

// Of rows with the same key the first is kept; the others must be equal to it.
bool Contradicts(const Database& database, const char* table) {
  return database.Integer(fmt::format(
             "SELECT count(*) FROM (SELECT * FROM part.{0} EXCEPT SELECT * FROM main.{0})",
             table)) != 0;
}

void AddPart(Database& database, const fs::path& part) {
  database.Prepare("ATTACH ? AS part").Bind(part.string()).Run();
  Transaction transaction(database);
  for (const char* table : kResults) {
    Copy(database, table);
    if (!Contradicts(database, table)) continue;
    throw InputError(
        {.file = part.string()},
        fmt::format("rows of table {} contradict those of the databases before it", table),
        "databases that the same program has written for the same sweep");
  }
  for (const char* table : kTimes) Copy(database, table);
  CopyRun(database);
  transaction.Commit();
  database.Execute("DETACH part");
}

}  // namespace

void Merge(const fs::path& out, const std::vector<fs::path>& parts) {
  const SweepFacts facts = Store::Open(parts.front()).Facts();
  for (const fs::path& part : parts) Store::Open(part).RequireSameSweep(facts);
  Store merged = Store::Create(out, facts);
  for (const fs::path& part : parts) AddPart(merged.database(), part);
  merged.Close();
}

}  // namespace assay::sweep
