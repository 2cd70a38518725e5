#pragma once

#include "planner/base/input_files/document.h"

namespace assay::cli {

// The kinds of files that the program reads, as named by a file's key `format`.
enum class FileFormat { kScenarioFile, kPartFile, kWorkcellFile, kPlanFile, kSweepFile };

// Returns the format of a file. Throws InputError if the key is missing or has another value.
FileFormat FormatOf(const Document& document);

}  // namespace assay::cli
