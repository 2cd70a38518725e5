#include "sim/sweep/database/merge.h"

#include <fmt/format.h>

#include <array>

#include "planner/base/input_files/input_error.h"
#include "sim/sweep/database/schema.h"
#include "sim/sweep/database/store.h"

namespace assay::sweep {
namespace {

namespace fs = std::filesystem;

// A table of results, and its columns that must be the same in all databases.
struct ResultTable {
  const char* name;
  const char* compared = "*";
  const char* conflict = "ON CONFLICT DO NOTHING";
};

// The tables are ordered so that a table comes after those that it refers to. The column with a
// command is not compared, because paths in it depend on where the program was started. The limits
// of a claim are not compared either, because they are those of several trials.
constexpr std::array kResults = {
    ResultTable{"cell"},
    ResultTable{"gate"},
    ResultTable{"gate_component"},
    ResultTable{"claim", "cell, claim, step, action, about, name, unit, proved, gate", kWidenClaim},
    ResultTable{"trial"},
    ResultTable{"verdict"},
    ResultTable{"observation"},
    ResultTable{"attack"},
    ResultTable{"attack_worst"},
    ResultTable{"counterexample",
                "cell, number, claim, action, name, unit, "
                "observed, low, high, margin, gate, noise,"
                " steps, replayed, multiple"},
    ResultTable{"conservatism"},
};
constexpr std::array kTimes = {ResultTable{"timing"}, ResultTable{"planning"}};

void CopyRun(Database& database) {
  database.Execute(
      "INSERT INTO main.run(started, shard, jobs, version, machine, cores, os, trials, steps,"
      " seconds)"
      " SELECT started, shard, jobs, version, machine, cores, os, trials, steps, seconds"
      " FROM part.run ORDER BY run");
}

void Copy(Database& database, const ResultTable& table) {
  database.Execute(fmt::format("INSERT INTO main.{0} SELECT * FROM part.{0} WHERE true {1}",
                               table.name, table.conflict));
}

// Returns whether a row of the part differs from the row with the same key that was copied first.
bool Contradicts(const Database& database, const ResultTable& table) {
  return database.Integer(fmt::format(
             "SELECT count(*) FROM (SELECT {1} FROM part.{0} EXCEPT SELECT {1} FROM main.{0})",
             table.name, table.compared)) != 0;
}

void AddPart(Database& database, const fs::path& part) {
  database.Prepare("ATTACH ? AS part").Bind(part.string()).Run();
  Transaction transaction(database);
  for (const ResultTable& table : kResults) {
    Copy(database, table);
    if (!Contradicts(database, table)) continue;
    throw InputError(
        {.file = part.string()},
        fmt::format("rows of table {} contradict those of the databases before it", table.name),
        "databases that the same program has written for the same sweep");
  }
  for (const ResultTable& table : kTimes) Copy(database, table);
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
