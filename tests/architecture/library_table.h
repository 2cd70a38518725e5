#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace assay::architecture {

// The table of libraries in the root CMakeLists.txt. It consists of the lines assay_library(FOLDER
// USES NAME...).
class LibraryTable {
 public:
  // Reads ROOT/CMakeLists.txt. Throws std::runtime_error if it cannot be read, or if USES names a
  // library that has no line.
  static LibraryTable Read(const std::filesystem::path& root);

  std::vector<std::string> folders() const;
  // Returns the folder of the table in which a file lies, or "" if there is none. The file's path
  // is from the root.
  std::string FolderOf(const std::string& file) const;
  // Returns the folders that the table lets `folder` use.
  const std::vector<std::string>& UsesOf(const std::string& folder) const;
  // Returns the folder itself and all folders that it uses, directly or indirectly.
  std::set<std::string> OpenTo(const std::string& folder) const;

 private:
  std::map<std::string, std::vector<std::string>> uses_;  // by folder, the folders that it uses
};

}  // namespace assay::architecture
