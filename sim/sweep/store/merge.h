#pragma once

#include <filesystem>
#include <vector>

namespace assay::sweep {

// Puts the databases of shards of one sweep together into a new one, the very one that a single run
// writes. A trial may be in several, if it is the same in all. Throws InputError if they are not of
// one sweep, or contradict each other.
void Merge(const std::filesystem::path& out, const std::vector<std::filesystem::path>& parts);

}  // namespace assay::sweep
