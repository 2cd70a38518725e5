#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace assay::cli {

// Only these functions open files to write. They throw EnvironmentError, with the path and the
// system's words, if a file cannot be written. They throw UsageError if they would overwrite a file
// that this command has read, by any path or link (planner/base/input_files/input_file.h).

// Checks that the file can be written. Call it before the work whose result the file will hold.
void RequireWritable(const std::filesystem::path& file);

// Replaces the file as a whole. The text is written beside the file, brought to the disk, and then
// renamed. No reader ever sees a part of it, and the old file stays if the disk is full or the
// power fails. Links are followed. A file that is not regular (a device, a pipe), or that is
// standard output or standard error, is written into.
void WriteFile(const std::filesystem::path& file, std::string_view text);

// RequireAmendable and AmendFile do the same for a file that the command has read in order to
// change it.
void RequireAmendable(const std::filesystem::path& file);
void AmendFile(const std::filesystem::path& file, std::string_view text);

// Replaces the file, as WriteFile does, with what `write` writes. `write` is given a path with the
// file's ending.
void WriteFileBy(const std::filesystem::path& file,
                 const std::function<void(const std::filesystem::path&)>& write);

// Makes the folder and the folders that it lies in, unless they exist.
void MakeFolder(const std::filesystem::path& folder);

}  // namespace assay::cli
