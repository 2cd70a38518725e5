#pragma once

#include <filesystem>
#include <vector>

namespace assay::sweep {

// Merges the databases of the shards of one sweep into a new database, which equals the database of
// a single run. A trial may be in several databases if it is the same in all. Throws InputError if
// the databases belong to different sweeps or contradict each other.
void Merge(const std::filesystem::path& out, const std::vector<std::filesystem::path>& parts);

}  // namespace assay::sweep
