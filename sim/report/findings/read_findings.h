#pragma once

#include <string>

#include "sim/report/findings/findings.h"

namespace assay::report {

// Reads the findings from a database of results. Throws the errors of sweep::Store.
Findings ReadFindings(const sweep::Store& store, const std::string& database);

}  // namespace assay::report
