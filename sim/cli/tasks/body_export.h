#pragma once

#include <filesystem>

#include "planner/domain/workcell/model_path.h"

namespace assay::cli {

// The export of a part, or of the two parts of a mating, for other programs.
struct BodyExport {
  enum class Format { kMjcf, kUrdf, kObj };

  // a part file, the folder of a part, or a scenario, whose last mating gives the two parts
  std::filesystem::path input;
  std::filesystem::path output;  // empty: the text is printed
  domain::ModelPath models;
  Format format = Format::kMjcf;
  double clearance_mm = 0.5;  // of the holes of a part file
};

// Writes the files. For a pair of parts, it measures the play of the shaft in the unmodified
// engine. It states the play in the MJCF file, and prints it if there is an output file. Throws
// UsageError if the input has no parts to export, or if several files would have to be printed.
void ExportBodies(const BodyExport& request);

}  // namespace assay::cli
