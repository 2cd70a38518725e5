#pragma once

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

namespace assay {

// Returns the path of a file that a test may write. Its folder belongs to this process alone, even
// if an earlier test was killed and left its own, and is removed at the end of the process. CTest runs the tests of one program side by side, each in its own process.
inline std::filesystem::path ScratchFile(const std::string& name) {
  struct Folder {
    std::filesystem::path path;
    Folder() {
      std::string name = std::filesystem::temp_directory_path() / "assay-test-XXXXXX";
      if (mkdtemp(name.data()) == nullptr) throw std::runtime_error(name + " cannot be made");
      path = name;
    }
    ~Folder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  };
  static const Folder folder;
  return folder.path / name;
}

}  // namespace assay
