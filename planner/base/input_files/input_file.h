#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace assay {

// Input files are opened only by these functions. They remember every file that was read, so that
// no output of the same command overwrites one of them.

inline constexpr std::size_t kMostInputBytes = std::size_t{8} << 20;

// Returns the contents of a file, byte for byte. `allowed` describes the expected file for
// messages. Throws InputError if the file cannot be read or is larger than `most` bytes. If there
// is no file of this name, the error names the nearest one in the folder.
std::string ReadInput(const std::filesystem::path& file, std::string_view allowed,
                      std::size_t most = kMostInputBytes);

// Remembers a file that is read by other code (a database).
void RememberInput(const std::filesystem::path& file);

// Returns true if the file is one of those that were read, by any path or link.
bool IsInput(const std::filesystem::path& file);

// Collects the files that ReadInput reads in this thread while the object lives. Objects may be
// nested.
class FilesRead {
 public:
  FilesRead();
  ~FilesRead();
  FilesRead(const FilesRead&) = delete;
  FilesRead& operator=(const FilesRead&) = delete;

  // Returns a hash of these files. It depends only on their contents and names, not on their
  // folders or on the order of reading. A copy of a project has the same hash.
  std::string Digest() const;

 private:
  friend std::string ReadInput(const std::filesystem::path&, std::string_view, std::size_t);
  void Add(const std::filesystem::path& file, const std::string& digest);

  std::map<std::filesystem::path, std::string> digests_;  // by canonical path
  FilesRead* outer_;
};

// Throws InputError, with line and column, unless the whole text is UTF-8 without control
// characters other than tabs and line breaks.
void RequireText(std::string_view text, const std::string& file_name);

}  // namespace assay
