#pragma once

#include <string>
#include <vector>

#include "planner/base/input_files/document.h"
#include "planner/domain/parts/part_model.h"

namespace assay::domain {

// The words by which a scenario may name a part's stable poses: labels, then names.
class StablePoseNames {
 public:
  explicit StablePoseNames(const PartModel& model);

  // Returns the pose of a word. Throws InputError for an unknown word.
  StablePoseId Read(const Value& value) const { return poses_[value.OneOf(names_)]; }

 private:
  void Add(const std::string& name, StablePoseId pose);

  std::vector<std::string> names_;
  std::vector<StablePoseId> poses_;  // by index in names_
};

}  // namespace assay::domain
