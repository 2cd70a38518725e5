#pragma once

#include <string>

#include "sim/report/sections/findings.h"

namespace assay::report {

// Throws as Store does.
Findings ReadFindings(const sweep::Store& store, const std::string& database);

}  // namespace assay::report
