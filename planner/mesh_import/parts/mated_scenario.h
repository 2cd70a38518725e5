#pragma once

#include <string>

#include "planner/mesh_import/parts/mated_pair.h"

namespace assay::mesh_import {

// Returns a scenario in which the parts lie on the table and are assembled. The fixed part lies
// with its hole up if it can rest so, and the held part stands as nearly as it can as it is mated.
std::string ScenarioText(const MatedPair& pair);

}  // namespace assay::mesh_import
