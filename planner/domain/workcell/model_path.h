#pragma once

#include <concepts>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace assay::domain {

// The folders that are searched for models, in this order. Each may hold parts/NAME/part.yaml and
// workcells/NAME/workcell.yaml. Robots and grippers are found from the workcell's own file, which
// names them.
class ModelPath {
 public:
  ModelPath() = default;
  // Creates a path with a single folder of models and workcells; with none if its name is empty.
  template <std::convertible_to<std::filesystem::path> Folder>
  ModelPath(const Folder& folder) {  // NOLINT(google-explicit-constructor)
    Append(folder);
  }

  void Append(std::filesystem::path folder) {
    if (!folder.empty()) folders_.push_back(std::move(folder));
  }
  bool empty() const { return folders_.empty(); }
  const std::vector<std::filesystem::path>& folders() const { return folders_; }

  // Return the names of the models that exist.
  std::vector<std::string> Parts() const;
  std::vector<std::string> Workcells() const;

  // Return the file of a model, from the first folder that has it. If none has it, they return its
  // place in the last folder.
  std::filesystem::path PartFile(const std::string& name) const;
  std::filesystem::path WorkcellFile(const std::string& name) const;

 private:
  std::vector<std::filesystem::path> folders_;
};

}  // namespace assay::domain
