#pragma once

#include <filesystem>

namespace assay::cli {

// The folder with parts/ and workcells/: the one given, if any, else the one that belongs to the
// input file. Throws InputError if there is none.
std::filesystem::path FindModels(const std::filesystem::path& given,
                                 const std::filesystem::path& input);

// For verbs without an input file: the one given, else the one that belongs to the working
// directory, else the one that was installed. Throws EnvironmentError if there is none.
std::filesystem::path FindModelsHere(const std::filesystem::path& given);

}  // namespace assay::cli
