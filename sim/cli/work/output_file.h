#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace assay::cli {

// The one place that opens files to write. Everything here throws EnvironmentError, with the path
// and the system's words, if it cannot be done, and UsageError if it would overwrite a file that
// this command has read, by whatever path or link (planner/base/document/input_file.h).

// Asked before work begins whose result is to be written there.
void RequireWritable(const std::filesystem::path& file);

// Replaces the file as a whole: written beside it, brought to the disk, then renamed, so that
// nobody ever sees a part of it, and what was there before stays if the disk is full or the power
// fails. Links are followed. What is no regular file (a device, a pipe) is written into, and so is
// a file that is standard output or standard error.
void WriteFile(const std::filesystem::path& file, std::string_view text);

// The same for a file that the command was told to change, and has therefore read.
void RequireAmendable(const std::filesystem::path& file);
void AmendFile(const std::filesystem::path& file, std::string_view text);

// The same for what `write` writes to the path that it is given, which has the file's ending.
void WriteFileBy(const std::filesystem::path& file,
                 const std::function<void(const std::filesystem::path&)>& write);

// Makes the folder, and those it lies in, unless it is there.
void MakeFolder(const std::filesystem::path& folder);

}  // namespace assay::cli
