#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>
#include <system_error>

namespace assay {

// Returns the path of a file that a test may write. Its folder belongs to this process and is
// removed at its end. CTest runs the tests of one program side by side, each in its own process.
inline std::filesystem::path ScratchFile(const std::string& name) {
  struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("assay-test-" + std::to_string(getpid()));
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  };
  static const Folder folder;
  return folder.path / name;
}

}  // namespace assay
