#pragma once

#include <string>
#include <vector>

#include "planner/mesh_import/parts/imported_part.h"

namespace assay::mesh_import {

// Returns full sentences for people about how a part was made from meshes: the unit, the repairs,
// the dimensions that were found, the distances, and what was assumed.
std::vector<std::string> AccountOf(const ImportedPart& part);

// Returns the README of the part's folder, which derives the numbers of the part file.
std::string ReadmeText(const ImportedPart& part);

}  // namespace assay::mesh_import
