#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace assay::cli {

// All throw EnvironmentError, with the path and the system's words, if they cannot do it.

// Asked before work begins whose result is to be written there.
void RequireWritable(const std::filesystem::path& file);

// Replaces the file as a whole: written under a temporary name beside it, then renamed, so that
// nobody ever sees a part of it, and what was there before stays if the disk is full.
void WriteFile(const std::filesystem::path& file, std::string_view text);

// The same for what `write` writes to the path that it is given, which has the file's ending.
void WriteFileBy(const std::filesystem::path& file,
                 const std::function<void(const std::filesystem::path&)>& write);

// Makes the folder, and those it lies in, unless it is there.
void MakeFolder(const std::filesystem::path& folder);

}  // namespace assay::cli
