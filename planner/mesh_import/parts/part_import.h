#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "planner/mesh_import/parts/imported_part.h"

namespace assay::mesh_import {

// Reads the files of one part, which have one frame and one unit. Throws InputError for what cannot
// be read, repaired or understood, with the place.
ImportedPart Import(const std::vector<std::filesystem::path>& files, const std::string& name,
                    const ImportOptions& options);

}  // namespace assay::mesh_import
