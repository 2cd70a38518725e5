#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace assay::architecture {

// The table of libraries in the root CMakeLists.txt: its lines assay_library(FOLDER USES NAME...).
class LibraryTable {
 public:
  // Reads ROOT/CMakeLists.txt. Throws std::runtime_error if it cannot be read, or if USES names a
  // library that has no line.
  static LibraryTable Read(const std::filesystem::path& root);

  std::vector<std::string> folders() const;
  // The folder of the table that a file lies in, as written from the root; "" if there is none.
  std::string FolderOf(const std::string& file) const;
  // The folders that stand beside it in the table.
  const std::vector<std::string>& UsesOf(const std::string& folder) const;
  // The folder itself, what stands beside it in the table, and what those use.
  std::set<std::string> OpenTo(const std::string& folder) const;

 private:
  std::map<std::string, std::vector<std::string>> uses_;  // folder -> folders
};

}  // namespace assay::architecture
