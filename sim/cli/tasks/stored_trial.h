#pragma once

#include <filesystem>
#include <string_view>

#include "sim/sweep/grid/sweep_file.h"
#include "sim/sweep/runner/work.h"

namespace assay::cli {

// Returns the sweep file of a database, from its old path in the working directory or from beside
// the database. Throws InputError if it is not there, or has changed.
sweep::Sweep SweepOf(const sweep::Store& store);

// Returns a trial of a database by its number. Error messages begin with `verb`. Throws UsageError
// if there is no trial with this number, or if the trial was not executed.
sweep::TrialRecord StoredTrial(const sweep::Store& store, int number, std::string_view verb);

// Returns the cell of the sweep to which a stored trial belongs, with the stored plan. All verbs
// that repeat or show a stored trial use this function. `models` are the folders that the user
// gave; if it is empty, the folder of models is searched for.
sweep::PlannedCell RestoredCell(const sweep::Store& store, const sweep::TrialRecord& trial,
                                const domain::ModelPath& models);

}  // namespace assay::cli
