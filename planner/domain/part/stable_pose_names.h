#pragma once

#include <string>
#include <vector>

#include "planner/base/document/document.h"
#include "planner/domain/part/part_model.h"

namespace assay::domain {

// The words by which a scenario may call a part's stable poses: labels, then names.
class StablePoseNames {
 public:
  explicit StablePoseNames(const PartModel& model);

  // Throws InputError for another word.
  StablePoseId Read(const Value& value) const { return poses_[value.OneOf(names_)]; }

 private:
  void Add(const std::string& name, StablePoseId pose);

  std::vector<std::string> names_;
  std::vector<StablePoseId> poses_;  // by name
};

}  // namespace assay::domain
