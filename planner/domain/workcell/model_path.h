#pragma once

#include <concepts>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace assay::domain {

// The folders in which models are looked for, in this order: each may hold parts/NAME/part.yaml and
// workcells/NAME/workcell.yaml. What a workcell names (robots, grippers) is named from its own
// file.
class ModelPath {
 public:
  ModelPath() = default;
  // A single folder; none where its name is empty.
  template <std::convertible_to<std::filesystem::path> Folder>
  ModelPath(const Folder& folder) {  // NOLINT(google-explicit-constructor)
    Append(folder);
  }

  void Append(std::filesystem::path folder) {
    if (!folder.empty()) folders_.push_back(std::move(folder));
  }
  bool empty() const { return folders_.empty(); }
  const std::vector<std::filesystem::path>& folders() const { return folders_; }

  // The models that there are, by name.
  std::vector<std::string> Parts() const;
  std::vector<std::string> Workcells() const;

  // The file of a model: of the first folder that has it; none has it: where it would be in the
  // last one.
  std::filesystem::path PartFile(const std::string& name) const;
  std::filesystem::path WorkcellFile(const std::string& name) const;

 private:
  std::vector<std::filesystem::path> folders_;
};

}  // namespace assay::domain
