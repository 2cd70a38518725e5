#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace assay {

// The one place that opens files to read. It remembers every file that was read, so that no output
// of the same command overwrites one of them.

inline constexpr std::size_t kMostInputBytes = std::size_t{8} << 20;

// All of a file, byte for byte. Throws InputError, which names the nearest file of the folder if
// there is none of this name, if it cannot be read or is larger than `most` bytes. `allowed`: what
// the file should be.
std::string ReadInput(const std::filesystem::path& file, std::string_view allowed,
                      std::size_t most = kMostInputBytes);

// Remembers a file that others read (a database).
void RememberInput(const std::filesystem::path& file);

// Whether the file is one of those that were read, by whatever path or link it is named.
bool IsInput(const std::filesystem::path& file);

// A hash of all that ReadInput has read so far: the same for the same contents under the same
// canonical paths, in whatever order they were read.
std::string DigestOfInputs();

// Throws InputError, with line and column, unless all of the text is UTF-8 without control
// characters other than tabs and line breaks.
void RequireText(std::string_view text, const std::string& file_name);

}  // namespace assay
