#pragma once

#include <filesystem>

#include "sim/sweep/run/sweep_file.h"
#include "sim/sweep/run/work.h"

namespace assay::cli {

// The sweep file of a database: where it was, from the working directory or
// beside the database. Throws InputError if it is not there, or has changed.
sweep::Sweep SweepOf(const sweep::Store& store);

// The cell of a trial, with the plan that is stored. `models`: the folder;
// empty: found.
sweep::PlannedCell RestoredCell(const sweep::Store& store, const sweep::TrialRecord& trial,
                                const domain::ModelPath& models);

}  // namespace assay::cli
