#include "sim/cli/tasks/stored_trial.h"

#include <fmt/format.h>

#include <optional>
#include <system_error>

#include "planner/base/input_files/input_error.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/tasks/noise_floor_cache.h"

namespace assay::cli {

namespace fs = std::filesystem;

sweep::Sweep SweepOf(const sweep::Store& store) {
  const fs::path stored = store.Facts().at("path");
  const fs::path beside = store.file().parent_path() / stored.filename();
  std::error_code ignored;
  sweep::Sweep sweep =
      sweep::Load(!fs::exists(stored, ignored) && fs::exists(beside, ignored) ? beside : stored);
  store.RequireSameSweep(sweep::FactsOf(sweep, ASSAY_VERSION));
  return sweep;
}

sweep::TrialRecord StoredTrial(const sweep::Store& store, int number, std::string_view verb) {
  const int trials = store.TrialsInAll();
  if (number > trials) {
    throw UsageError(
        fmt::format("{}: there is no trial {}; allowed: 1 to {}", verb, number, trials));
  }
  const std::optional<sweep::TrialRecord> record = store.FindTrial(number);
  if (!record) {
    throw UsageError(
        fmt::format("{}: trial {} is not in {}: its cell has no plan, or it was not done yet (see "
                    "assay sweep show)",
                    verb, number, store.file().string()));
  }
  return *record;
}

namespace {

// An error in a stored plan is reported as an error in the database.
sweep::PlannedCell Restored(const sweep::Store& store, const sweep::Sweep& sweep,
                            const domain::ModelPath& models, const sweep::Cell& cell,
                            const sweep::CellRecord& record) {
  try {
    return sweep::RealWork(sweep, models, KeptNoiseFloor).restore(cell, record);
  } catch (const InputError& error) {
    throw InputError({.file = store.file().string()}, error.what(), "");
  }
}

}  // namespace

sweep::PlannedCell RestoredCell(const sweep::Store& store, const sweep::TrialRecord& trial,
                                const domain::ModelPath& models) {
  const sweep::Sweep sweep = SweepOf(store);
  const std::vector<sweep::Cell> cells = sweep::Cells(sweep);
  const sweep::Cell& cell = cells[sweep::PlaceOf(cells, trial.trial).cell];
  for (const sweep::CellRecord& record : store.Cells()) {
    if (record.cell == cell.number) return Restored(store, sweep, models, cell, record);
  }
  throw InputError({.file = store.file().string()}, fmt::format("cell {} is missing", cell.number),
                   "a database as it was written");
}

}  // namespace assay::cli
