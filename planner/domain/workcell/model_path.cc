#include "planner/domain/workcell/model_path.h"

#include <set>

namespace assay::domain {
namespace {

namespace fs = std::filesystem;

// A kind of model. Its files are models/KIND/NAME/FILE.
struct Kind {
  const char* folder;
  const char* file;
};
constexpr Kind kPart = {"parts", "part.yaml"};
constexpr Kind kWorkcell = {"workcells", "workcell.yaml"};

std::vector<std::string> NamesOf(const Kind& kind, const std::vector<fs::path>& folders) {
  std::set<std::string> names;
  for (const fs::path& folder : folders) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder / kind.folder, error)) {
      if (fs::exists(entry.path() / kind.file, error)) names.insert(entry.path().filename());
    }
  }
  return {names.begin(), names.end()};
}

fs::path FileOf(const Kind& kind, const std::string& name, const std::vector<fs::path>& folders) {
  fs::path file;
  for (const fs::path& folder : folders) {
    file = folder / kind.folder / name / kind.file;
    std::error_code error;
    if (fs::exists(file, error)) return file;
  }
  return file;
}

}  // namespace

std::vector<std::string> ModelPath::Parts() const { return NamesOf(kPart, folders_); }
std::vector<std::string> ModelPath::Workcells() const { return NamesOf(kWorkcell, folders_); }

fs::path ModelPath::PartFile(const std::string& name) const {
  return FileOf(kPart, name, folders_);
}
fs::path ModelPath::WorkcellFile(const std::string& name) const {
  return FileOf(kWorkcell, name, folders_);
}

}  // namespace assay::domain
