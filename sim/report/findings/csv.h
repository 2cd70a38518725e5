#pragma once

#include <string>
#include <vector>

#include "sim/report/findings/findings.h"

namespace assay::report {

// A table for programs (RFC 4180, but lines end with a newline alone). Numbers have all their
// digits and are in metres, radians and seconds. Missing values are empty.
struct CsvFile {
  std::string name;  // like "verdicts.csv"
  std::string text;
};

// Returns the findings as files for programs: one for each table of the report, with all cells.
std::vector<CsvFile> CsvFiles(const Findings& findings);

}  // namespace assay::report
