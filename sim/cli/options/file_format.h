#pragma once

#include "planner/base/document/document.h"

namespace assay::cli {

// What a file says it is, by its key `format`.
enum class FileFormat { kScenarioFile, kPartFile, kWorkcellFile, kPlanFile, kSweepFile };

// Throws InputError if the key is missing or names none of these.
FileFormat FormatOf(const Document& document);

}  // namespace assay::cli
