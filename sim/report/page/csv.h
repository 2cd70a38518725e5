#pragma once

#include <string>
#include <vector>

#include "sim/report/sections/findings.h"

namespace assay::report {

// A table for programs (RFC 4180, lines ended by a newline alone): numbers with
// all their digits, in metres, radians and seconds; what there is not is empty.
struct CsvFile {
  std::string name;  // "verdicts.csv"
  std::string text;
};

// One for each table of the report, of all cells.
std::vector<CsvFile> CsvFiles(const Findings& findings);

}  // namespace assay::report
