#pragma once

#include <filesystem>

namespace assay::cli {

// The folder with parts/ and workcells/: the one given, if any; else a folder `models` (or
// `share/assay/models`, where assay is installed) in the folder of the input file, in one that it
// lies in, or in the same way from the working directory or from the program. Throws
// EnvironmentError if there is none.
std::filesystem::path FindModels(const std::filesystem::path& given,
                                 const std::filesystem::path& input);

}  // namespace assay::cli
