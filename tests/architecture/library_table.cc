#include "tests/architecture/library_table.h"

#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace assay::architecture {
namespace {

std::string WithoutComments(std::istream& cmake) {
  std::string text;
  for (std::string line; std::getline(cmake, line);) text += line.substr(0, line.find('#')) + '\n';
  return text;
}

// Returns the words after USES, up to the next keyword of assay_library(), assay_module(),
// assay_python_module() or assay_objects().
std::vector<std::string> WordsAfterUses(const std::string& arguments) {
  std::istringstream words(arguments);
  std::vector<std::string> uses;
  bool in_uses = false;
  for (std::string word; words >> word;) {
    if (word == "USES" || word == "LINKS" || word == "HIDES") {
      in_uses = word == "USES";
    } else if (in_uses) {
      uses.push_back(word);
    }
  }
  return uses;
}

std::string NameOf(const std::string& folder) { return folder.substr(folder.rfind('/') + 1); }

}  // namespace

LibraryTable LibraryTable::Read(const std::filesystem::path& root) {
  std::ifstream cmake(root / "CMakeLists.txt");
  if (!cmake) throw std::runtime_error("cannot read " + (root / "CMakeLists.txt").string());
  const std::string text = WithoutComments(cmake);
  const std::regex line(R"(assay_(?:library|module|python_module|objects)\(\s*([^\s)]+)([^)]*)\))");
  LibraryTable table;
  std::map<std::string, std::string> folder_of_name;
  const std::sregex_iterator begin(text.begin(), text.end(), line);
  for (auto match = begin; match != std::sregex_iterator(); ++match) {
    table.uses_[(*match)[1]] = WordsAfterUses((*match)[2]);
    folder_of_name[NameOf((*match)[1])] = (*match)[1];
  }
  for (auto& [folder, uses] : table.uses_) {
    for (std::string& use : uses) {
      if (!folder_of_name.contains(use)) throw std::runtime_error(folder + " uses unknown " + use);
      use = folder_of_name[use];
    }
  }
  return table;
}

std::vector<std::string> LibraryTable::folders() const {
  std::vector<std::string> folders;
  for (const auto& [folder, uses] : uses_) folders.push_back(folder);
  return folders;
}

std::string LibraryTable::FolderOf(const std::string& file) const {
  for (const auto& [folder, uses] : uses_) {
    if (file.starts_with(folder + '/')) return folder;
  }
  return "";
}

const std::vector<std::string>& LibraryTable::UsesOf(const std::string& folder) const {
  return uses_.at(folder);
}

std::set<std::string> LibraryTable::OpenTo(const std::string& folder) const {
  std::set<std::string> open = {folder};
  std::vector<std::string> pending = {folder};
  while (!pending.empty()) {
    const std::vector<std::string>& uses = uses_.at(pending.back());
    pending.pop_back();
    for (const std::string& use : uses) {
      if (open.insert(use).second) pending.push_back(use);
    }
  }
  return open;
}

}  // namespace assay::architecture
